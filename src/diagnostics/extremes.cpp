#include "diagnostics/extremes.hpp"

#include "diagnostics/number_reader.hpp"

namespace sphdrop {

namespace {

/// The vertex of the parabola through three samples, b not below a and c; b itself where the three lie on a line.
Peak parabola_vertex(Peak a, Peak b, Peak c) {
  const double rise = (b.value - a.value) / (b.time - a.time);
  const double fall = (c.value - b.value) / (c.time - b.time);
  const double curvature = (fall - rise) / (c.time - a.time);
  if (!(curvature < 0.0)) return b;
  const double time = 0.5 * (a.time + b.time) - rise / (2.0 * curvature);
  return {time, b.value + (time - b.time) * (rise + curvature * (time - a.time))};
}

}  // namespace

void PeakTracker::add(double time, double value) {
  const Peak now{time, value};
  if (known_ > 0 && !(time > last_.time)) return;
  if (known_ == 0 || value > sampled_.value) {
    sampled_ = refined_ = now;
  } else if (known_ == 2 && last_ == sampled_ && value < last_.value) {
    refined_ = parabola_vertex(previous_, last_, now);
  }
  previous_ = last_;
  last_ = now;
  if (known_ < 2) ++known_;
}

std::optional<Peak> PeakTracker::sampled() const {
  return known_ > 0 ? std::optional(sampled_) : std::nullopt;
}

std::optional<Peak> PeakTracker::refined() const {
  return known_ > 0 ? std::optional(refined_) : std::nullopt;
}

void PeakTracker::append_numbers(std::vector<double>& numbers) const {
  numbers.push_back(known_);
  for (const Peak& peak : {previous_, last_, sampled_, refined_}) {
    numbers.push_back(peak.time);
    numbers.push_back(peak.value);
  }
}

void PeakTracker::read_numbers(NumberReader& reader) {
  const double known = reader.number();
  if (known != 0.0 && known != 1.0 && known != 2.0) reader.fail("holds an impossible count");
  known_ = static_cast<int>(known);
  for (Peak* peak : {&previous_, &last_, &sampled_, &refined_}) {
    peak->time = reader.number();
    peak->value = reader.number();
  }
}

void ReboundTracker::add(bool in_contact, double vertical_velocity) {
  // The first sample in contact may already be slowed down: a hard body is stopped within a few of them.
  if (!touched_ && (!in_contact || before_ == 0.0)) before_ = vertical_velocity;
  // The force of the last instant in contact acts on the way to the next one, so only that one has the final velocity.
  if (!in_contact && in_contact_) after_ = vertical_velocity;
  touched_ = touched_ || in_contact;
  in_contact_ = in_contact;
}

std::optional<double> ReboundTracker::restitution() const {
  if (!touched_ || in_contact_ || before_ == 0.0) return std::nullopt;
  return -after_ / before_;
}

void ReboundTracker::append_numbers(std::vector<double>& numbers) const {
  numbers.insert(numbers.end(), {touched_ ? 1.0 : 0.0, in_contact_ ? 1.0 : 0.0, before_, after_});
}

void ReboundTracker::read_numbers(NumberReader& reader) {
  touched_ = reader.flag();
  in_contact_ = reader.flag();
  before_ = reader.number();
  after_ = reader.number();
}

void Extremes::add(double time, double drop_width, double deflection, std::int64_t contact_count,
                   double drop_velocity_y) {
  width_.add(time, drop_width);
  depth_.add(time, -deflection);
  rebound_.add(contact_count > 0, drop_velocity_y);
}

std::vector<double> Extremes::to_numbers() const {
  std::vector<double> numbers;
  width_.append_numbers(numbers);
  depth_.append_numbers(numbers);
  rebound_.append_numbers(numbers);
  return numbers;
}

Extremes Extremes::from_numbers(std::span<const double> numbers) {
  NumberReader reader(numbers, "record of extremes");
  Extremes extremes;
  extremes.width_.read_numbers(reader);
  extremes.depth_.read_numbers(reader);
  extremes.rebound_.read_numbers(reader);
  reader.expect_end();
  return extremes;
}

}  // namespace sphdrop
