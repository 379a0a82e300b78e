// The main program of tests that run under mpirun: rank 0 reports, and a failure on any rank fails the run.
#include <gtest/gtest.h>
#include <mpi.h>

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  auto& listeners = testing::UnitTest::GetInstance()->listeners();
  // Other ranks keep quiet unless something fails there: their failures would otherwise be lost.
  if (rank != 0) delete listeners.Release(listeners.default_result_printer());
  class FailurePrinter : public testing::EmptyTestEventListener {
   public:
    explicit FailurePrinter(int r) : rank_(r) {}
    void OnTestPartResult(const testing::TestPartResult& result) override {
      if (result.failed())
        fprintf(stderr, "[rank %d] %s:%d: %s\n", rank_, result.file_name(), result.line_number(), result.message());
    }

   private:
    int rank_;
  };
  if (rank != 0) listeners.Append(new FailurePrinter(rank));
  int failed = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return failed;
}
