#pragma once
// The widest drop, the deepest beam and the rebound, followed through the run.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sphdrop {

struct Peak {
  double time = 0;   ///< s
  double value = 0;  ///< in the unit of the samples
  friend bool operator==(const Peak&, const Peak&) = default;
};

/// The largest of a series of samples, as sampled and as the vertex of the parabola through it and its two neighbours.
class PeakTracker {
 public:
  /// Samples come in order of time; one that is not later than the last is passed over (a restarted run may repeat
  /// one).
  void add(double time, double value);

  /// The largest sample, the first one of equals; empty before the first sample.
  std::optional<Peak> sampled() const;
  /// The vertex of that parabola; the sample itself where it is the first or last of the series or part of a plateau.
  std::optional<Peak> refined() const;

  void append_numbers(std::vector<double>& numbers) const;
  void read_numbers(class NumberReader& reader);
  friend bool operator==(const PeakTracker&, const PeakTracker&) = default;

 private:
  int known_ = 0;  ///< how many of previous_ and last_ are filled: 0, 1 or 2
  Peak previous_, last_;
  Peak sampled_, refined_;
};

/// The drop's vertical speed before and after contact. Coefficient of restitution: - v_y after / v_y before, positive
/// for a rebound; it equals the ratio of momenta, as the drop's mass does not change.
class ReboundTracker {
 public:
  /// Vertical velocity of the drop's centre of mass (m/s) at an instant, before the contact force of that instant acts.
  void add(bool in_contact, double vertical_velocity);

  /// Of the last velocity before the first contact. Empty until contact has ended; every later contact starts it anew.
  std::optional<double> restitution() const;

  void append_numbers(std::vector<double>& numbers) const;
  void read_numbers(class NumberReader& reader);
  friend bool operator==(const ReboundTracker&, const ReboundTracker&) = default;

 private:
  bool touched_ = false, in_contact_ = false;
  double before_ = 0, after_ = 0;
};

/// Follows drop width D(t), deflection delta(t) and the rebound. Never allocates in add().
class Extremes {
 public:
  /// drop_width in m; deflection in m, negative downwards; contact_count as for ContactRecord; drop_velocity_y in m/s.
  void add(double time, double drop_width, double deflection, std::int64_t contact_count, double drop_velocity_y);

  const PeakTracker& width() const { return width_; }
  /// Of the depth -delta, so that the deepest deflection is a positive largest value.
  const PeakTracker& depth() const { return depth_; }
  std::optional<double> restitution() const { return rebound_.restitution(); }

  /// All there is to it as plain numbers, for another process or a checkpoint.
  std::vector<double> to_numbers() const;
  /// The tracker that gave these numbers, bit for bit. Throws std::invalid_argument where none can have given them.
  static Extremes from_numbers(std::span<const double> numbers);
  friend bool operator==(const Extremes&, const Extremes&) = default;

 private:
  PeakTracker width_, depth_;
  ReboundTracker rebound_;
};

}  // namespace sphdrop
