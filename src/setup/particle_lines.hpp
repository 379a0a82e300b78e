#pragma once
// How the particles of a drop are arranged about its centre: in lines, rings or columns, one after the other. A line's
// particles follow from its number, so that none has to be stored. m, kg per metre of depth.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "particles/elementary_functions.hpp"
#include "particles/vector.hpp"
#include "setup/box.hpp"

namespace sphdrop {

// Each has line_count(), line(l) and is_near(place, distance): false where no particle is within `distance` of `place`.
// A line has its count(), the place(j) and mass(j) of its particles j = 0, 1, ..., and a box() that holds them all.

/// Ring k at radius (k + 1/2) d' with round(2 pi (k + 1/2)) particles, which share the mass of their annulus.
class Rings {
 public:
  class Line {
   public:
    Line(int ring, double ring_spacing, double density);
    std::int64_t count() const { return count_; }
    Vector place(std::int64_t j) const {
      const double turns = static_cast<double>(j) / count_ + first_turn_;
      const SineCosine direction = sine_cosine(2.0 * std::numbers::pi * (turns - std::floor(turns)));
      return radius_ * Vector{direction.cosine, direction.sine};
    }
    double mass(std::int64_t) const { return mass_; }
    Box box() const { return {{-radius_, -radius_}, {radius_, radius_}}; }

   private:
    int count_;
    double mass_, radius_, first_turn_;
  };

  Rings(double radius, double spacing, double density);
  std::size_t line_count() const { return static_cast<std::size_t>(ring_count_); }
  Line line(std::size_t k) const { return {static_cast<int>(k), ring_spacing_, density_}; }
  bool is_near(Vector place, double distance) const { return length(place) <= radius_ + distance; }

 private:
  int ring_count_;
  double radius_, ring_spacing_, density_;
};

/// The part of a square lattice, symmetric about the centre, that lies in an ellipse; columns from left to right, all
/// masses equal.
class LatticeColumns {
 public:
  class Line {
   public:
    Line(int column, int half_count, double spacing, double mass)
        : half_count_(half_count), spacing_(spacing), x_((column + 0.5) * spacing), mass_(mass) {}
    std::int64_t count() const { return 2 * static_cast<std::int64_t>(half_count_); }
    Vector place(std::int64_t j) const { return {x_, (static_cast<int>(j) - half_count_ + 0.5) * spacing_}; }
    double mass(std::int64_t) const { return mass_; }
    Box box() const { return {place(0), place(count() - 1)}; }

   private:
    int half_count_;
    double spacing_, x_, mass_;
  };

  /// A disc of `radius`, or an ellipse, with `mass` in all.
  static LatticeColumns disc(double radius, double spacing, double mass);
  static LatticeColumns ellipse(double half_width, double half_height, double spacing, double mass);

  /// 0 where the shape is smaller than a cell.
  std::int64_t count() const { return count_; }
  std::size_t line_count() const { return half_counts_.size(); }
  Line line(std::size_t k) const {
    return {static_cast<int>(k) - static_cast<int>(half_counts_.size() / 2), half_counts_[k], spacing_, mass_};
  }
  bool is_near(Vector place, double distance) const;

 private:
  /// `contains`: whether a place is in the shape.
  template <class Contains>
  LatticeColumns(Vector half_axes, double spacing, double mass, Contains&& contains);

  Vector half_axes_;
  double spacing_, mass_;                  // of a particle
  std::vector<std::int32_t> half_counts_;  // of the particles above the centre, by column
  std::int64_t count_ = 0;
};

/// n x n particles, n = round(side/d), at the centres of the n x n cells of a square; columns from left to right.
class SquareColumns {
 public:
  class Line {
   public:
    Line(int column, int count, double cell, double mass) : column_(column), count_(count), cell_(cell), mass_(mass) {}
    std::int64_t count() const { return count_; }
    // Half-integers are exact, and so is the symmetry about the centre.
    Vector place(std::int64_t row) const {
      return cell_ * Vector{column_ + 0.5 - 0.5 * count_, static_cast<int>(row) + 0.5 - 0.5 * count_};
    }
    double mass(std::int64_t) const { return mass_; }
    Box box() const { return {place(0), place(count_ - 1)}; }

   private:
    int column_, count_;
    double cell_, mass_;
  };

  SquareColumns(double side, double spacing, double density);
  std::size_t line_count() const { return static_cast<std::size_t>(count_); }
  Line line(std::size_t k) const { return {static_cast<int>(k), count_, cell_, mass_}; }
  bool is_near(Vector place, double distance) const;

 private:
  int count_;
  double half_side_, cell_, mass_;
};

/// Particles as they are given, in one line. Those of a file are read, and kept, by every process.
class ListedParticles {
 public:
  class Line {
   public:
    explicit Line(const ListedParticles& all) : all_(all) {}
    std::int64_t count() const { return static_cast<std::int64_t>(all_.positions_.size()); }
    Vector place(std::int64_t j) const { return all_.positions_[static_cast<std::size_t>(j)]; }
    double mass(std::int64_t j) const { return all_.masses_[static_cast<std::size_t>(j)]; }
    Box box() const { return all_.box_; }

   private:
    const ListedParticles& all_;
  };

  ListedParticles() = default;
  ListedParticles(std::vector<Vector> positions, std::vector<double> masses);
  std::size_t line_count() const { return 1; }
  Line line(std::size_t) const { return Line(*this); }
  bool is_near(Vector place, double distance) const { return box_.grown_by(distance).contains(place); }

 private:
  std::vector<Vector> positions_;
  std::vector<double> masses_;
  Box box_;
};

}  // namespace sphdrop
