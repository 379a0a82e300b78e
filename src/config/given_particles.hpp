#pragma once
// The particles of a drop that is given by a file.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sphdrop {

/// A place of the plane, m.
struct Point {
  double x = 0, y = 0;
  bool operator==(const Point&) const = default;
};

/// In SI units, in the order of the file. Shapes: [particles].
struct GivenParticles {
  std::string file;                            ///< as messages name it
  std::vector<double> x, y;                    ///< m
  std::vector<double> velocity_x, velocity_y;  ///< m/s; empty: the file has none
  std::vector<double> mass;                    ///< kg per metre of depth; empty: the file has none
  std::vector<std::int64_t> lines;             ///< of the file, from 1 on; empty: rows of HDF5, which count from 0
  std::string checksum;                        ///< of the file's bytes
  std::string path;                            ///< the file that was read, absolute
  std::string content;                         ///< the file's bytes, for the one process that has read them

  std::size_t size() const { return x.size(); }
  bool has_velocities() const { return !velocity_x.empty(); }

  /// "drop.csv:12" or "drop.h5: row 10", to begin a message with.
  std::string place_of(std::size_t k) const {
    return lines.empty() ? file + ": row " + std::to_string(k) : file + ":" + std::to_string(lines[k]);
  }

  /// kg/m; 0 where the file has no masses.
  double total_mass() const {
    double total = 0;
    for (const double one : mass) total += one;
    return total;
  }

  /// Of mass; all particles have the same where the file has none.
  Point centre() const {
    Point sum;
    double weight = 0;
    for (std::size_t k = 0; k < size(); ++k) {
      const double one = mass.empty() ? 1.0 : mass[k];
      sum.x += one * x[k];
      sum.y += one * y[k];
      weight += one;
    }
    return {sum.x / weight, sum.y / weight};
  }

  /// From the centre to the particle farthest from it, m.
  double largest_radius() const {
    const Point middle = centre();
    double largest = 0;
    for (std::size_t k = 0; k < size(); ++k) {
      const double dx = x[k] - middle.x, dy = y[k] - middle.y;
      largest = std::max(largest, dx * dx + dy * dy);
    }
    return std::sqrt(largest);
  }

  /// m/s; 0 where the file has no velocities.
  double largest_speed() const {
    double largest = 0;
    for (std::size_t k = 0; k < velocity_x.size(); ++k)
      largest = std::max(largest, velocity_x[k] * velocity_x[k] + velocity_y[k] * velocity_y[k]);
    return std::sqrt(largest);
  }
};

/// Those of a case, if they have been read. Cases that differ in them differ in their checksum, a parameter.
struct GivenParticlesOfCase {
  std::shared_ptr<const GivenParticles> particles;
  const GivenParticles* operator->() const { return particles.get(); }
  explicit operator bool() const { return particles != nullptr; }
  bool operator==(const GivenParticlesOfCase&) const { return true; }
};

}  // namespace sphdrop
