#pragma once
// The history of the contact between drop and solid, condensed as the run goes.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "particles/vector.hpp"

namespace sphdrop {

/// When drop and solid touched, and the impulse given to the solid. Fed once a step; allocates only in its constructor
/// and when a gap of more than gap_limit ends. First-to-last contact time scatters with stray particles, so the time by
/// which a fraction of the impulse has been given is kept beside it (method.md, section 4).
class ContactRecord {
 public:
  struct Gap {
    double start = 0;  ///< last instant of contact before, s
    double end = 0;    ///< first instant of contact after, s
    friend bool operator==(const Gap&, const Gap&) = default;
  };

  /// The impulse's course is sampled at most once in sample_interval (s). Once maximum_samples are held every other one
  /// is dropped and the interval doubled, so memory is bounded however long the run. Throws std::invalid_argument
  /// unless sample_interval > 0, gap_limit >= 0 and maximum_samples >= 4.
  explicit ContactRecord(double sample_interval = 1e-6, double gap_limit = 20e-6, std::size_t maximum_samples = 16384);

  /// The step from time to time + dt: how many fluid particles touch at time, and the force on the solid during the
  /// step (N/m). Times must not decrease.
  void add(double time, double dt, std::int64_t contact_count, Vector force_on_solid);

  /// First and last instant with a particle in contact, s; empty as long as there was none.
  std::optional<double> first_contact() const;
  std::optional<double> last_contact() const;

  /// Times without contact longer than the limit, between the first and the last contact, in order.
  const std::vector<Gap>& gaps() const { return gaps_; }
  double gap_limit() const { return gap_limit_; }

  /// The integral of force_on_solid over time so far, N s/m.
  Vector impulse() const { return impulse_; }

  /// The first time at which the given fraction (0 < fraction <= 1) of the vertical impulse so far had been given, s,
  /// by linear interpolation between samples. Empty where that impulse is zero.
  std::optional<double> impulse_time(double fraction = 0.99) const;

  /// All there is to it as plain numbers, for another process or a checkpoint.
  std::vector<double> to_numbers() const;
  /// The record that gave these numbers, bit for bit. Throws std::invalid_argument where no record can have given them.
  static ContactRecord from_numbers(std::span<const double> numbers);

  friend bool operator==(const ContactRecord&, const ContactRecord&) = default;

 private:
  struct Sample {
    double time = 0, vertical_impulse = 0;
    friend bool operator==(const Sample&, const Sample&) = default;
  };

  void sample();

  double sample_interval_, gap_limit_;
  std::size_t maximum_samples_;
  bool touched_ = false;
  double first_ = 0, last_ = 0;
  double now_ = 0;  ///< the time up to which the impulse has been summed
  Vector impulse_;
  std::vector<Gap> gaps_;
  std::vector<Sample> samples_;
};

}  // namespace sphdrop
