#pragma once
// The arcs of the liquid's boundary among many particles (Sec 2.5).

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "particles/vector.hpp"
#include "sph/cell_grid.hpp"
#include "surface_tension/boundary_detection.hpp"

namespace sphdrop {

/// Looks for the arcs of ArcFinder among particles that are all given together. Those inside are sorted out first, by
/// NearDirections.
class ArcSearch {
 public:
  /// radius: R = 2h, m.
  explicit ArcSearch(double radius);

  /// Appends the arcs of the first `searched` particles, and for each where its particle is (m), in no order but that
  /// arcs of a particle follow one another as ArcFinder finds them. Shapes of x, y (m) and ids: [n]; among them must be
  /// all particles within 4h of those searched.
  void find(std::span<const double> x, std::span<const double> y, std::span<const std::int64_t> ids,
            std::size_t searched, std::vector<Arc>& arcs, std::vector<Vector>& centres);

 private:
  void sort_by_cell(const CellGrid& grid, std::span<const double> x, std::span<const double> y,
                    std::span<const std::int64_t> ids, std::size_t searched);
  void find_open(const CellGrid& grid);
  void find_arcs_of(const CellGrid& grid, std::size_t place, std::vector<Arc>& arcs);
  /// To the finder, those whose squared distance is at least `low` and below `high`, m2, both at most `reach` squared.
  void add_between(double low, double high, double reach, const CellGrid& grid, Vector here);
  /// Of those that are not near, those whose circles reach into a gap between the covers of near ones.
  void add_those_in(const Arc& gap, const CellGrid& grid, Vector here);
  bool lower_is_here(const CellGrid& grid, std::size_t place) const;

  double radius_;
  double near_reach_, reach_;  // m, of cells
  double squared_near_reach_;  // m2
  ArcFinder finder_;

  // The particles in the order of their cells, and some more that are far away, to fill up the last vector.
  std::vector<double> x_, y_;
  std::vector<std::int64_t> ids_;
  std::vector<char> is_searched_;
  std::vector<std::size_t> open_;  // places of those that are not surely inside
  // Of one particle.
  std::vector<Arc> gaps_;
};

}  // namespace sphdrop
