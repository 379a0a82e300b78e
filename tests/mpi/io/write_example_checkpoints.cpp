// Writes checkpoints of the steps 100, 200 and 300 into a directory (argv[1]), of which two are kept, for the tests of
// the reader; run by test_failing_disk.py on a disk that fails, too. An error is told by each rank, and the next
// checkpoint tried all the same.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>

#include "checkpoint_samples.hpp"
#include "io/output_directory.hpp"

int main(int argc, char** argv) {
  const sphdrop::MpiEnvironment environment(argc, argv);
  const sphdrop::Communicator world(MPI_COMM_WORLD);
  if (argc != 2) {
    fmt::print(stderr, "usage: write_example_checkpoints DIRECTORY\n");
    return 2;
  }
  int status = 0;
  sphdrop::prepare_output_directory(world, argv[1]);
  for (const std::int64_t step : {100, 200, 300}) {
    try {
      sphdrop::test::write_sample(world, argv[1], step, 2, 3000, 1000);
    } catch (const std::exception& error) {
      fmt::print(stderr, "rank {}: {}\n", world.rank(), error.what());
      status = 3;
    }
  }
  return status;
}
