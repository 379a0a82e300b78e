// A probe that history.csv does not have: the largest pressure in the liquid and where it is, every 10 us.
//   mpirun -np 2 probe CASE FOLDER [section.parameter=value ...]
#include <algorithm>
#include <fstream>
#include <iostream>
#include <sphdrop/sphdrop.hpp>

using namespace sphdrop::v1;

void run(const Case& input, const std::string& folder) {
  Simulation simulation(MPI_COMM_WORLD, input, Results{.folder = folder});
  std::ofstream file(simulation.rank() == 0 ? folder + "/probe.csv" : "/dev/null");
  file.precision(17);
  file << "time,largest_pressure,x,y\n";
  simulation.every(1e-5, [&](Simulation& now) {  // collective: every rank calls it, and column() gives all to each
    const std::vector<double> pressure = now.column(Material::drop, "pressure");
    const std::vector<double> x = now.column(Material::drop, "position_x"),
                              y = now.column(Material::drop, "position_y");
    const auto at = static_cast<std::size_t>(std::max_element(pressure.begin(), pressure.end()) - pressure.begin());
    file << now.time() << ',' << pressure[at] << ',' << x[at] << ',' << y[at] << '\n';
  });
  simulation.run();
  if (simulation.rank() == 0) std::cout << simulation.summary();
}

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int code = 0, rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  try {
    if (argc < 3) throw Error(Error::Kind::mistake, "usage: probe CASE FOLDER [section.parameter=value ...]");
    run(Case::from_file(MPI_COMM_WORLD, argv[1], {argv + 3, argv + argc}), argv[2]);
  } catch (const Error& error) {  // thrown on all ranks together
    if (rank == 0) std::cerr << error.what() << '\n';
    code = static_cast<int>(error.kind());
  }
  MPI_Finalize();
  return code;
}
