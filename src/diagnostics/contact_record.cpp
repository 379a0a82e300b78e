#include "diagnostics/contact_record.hpp"

#include <cassert>
#include <stdexcept>

#include "diagnostics/number_reader.hpp"

namespace sphdrop {

ContactRecord::ContactRecord(double sample_interval, double gap_limit, std::size_t maximum_samples)
    : sample_interval_(sample_interval), gap_limit_(gap_limit), maximum_samples_(maximum_samples) {
  if (!(sample_interval > 0.0)) throw std::invalid_argument("a contact record's sample interval must be positive");
  if (!(gap_limit >= 0.0)) throw std::invalid_argument("a contact record's gap limit must not be negative");
  if (maximum_samples < 4) throw std::invalid_argument("a contact record needs room for four samples at least");
  samples_.reserve(maximum_samples);
}

void ContactRecord::add(double time, double dt, std::int64_t contact_count, Vector force_on_solid) {
  assert(dt >= 0.0 && contact_count >= 0);
  if (contact_count > 0) {
    if (!touched_) {
      touched_ = true;
      first_ = time;
      samples_.push_back({time, 0.0});
    } else if (time - last_ > gap_limit_) {
      gaps_.push_back({last_, time});
    }
    last_ = time;
  }
  if (!touched_) return;
  impulse_ += dt * force_on_solid;
  now_ = time + dt;
  if (now_ - samples_.back().time >= sample_interval_) sample();
}

void ContactRecord::sample() {
  const std::size_t n = samples_.size();
  // While nothing is given the last sample moves along: a flat stretch takes two samples, whatever its length.
  if (n >= 2 && samples_[n - 1].vertical_impulse == impulse_.y && samples_[n - 2].vertical_impulse == impulse_.y) {
    samples_.back().time = now_;
    return;
  }
  if (n == maximum_samples_) {
    for (std::size_t i = 0; 2 * i < n; ++i) samples_[i] = samples_[2 * i];
    samples_.resize((n + 1) / 2);
    sample_interval_ *= 2.0;
  }
  samples_.push_back({now_, impulse_.y});
}

std::optional<double> ContactRecord::first_contact() const {
  return touched_ ? std::optional<double>(first_) : std::nullopt;
}

std::optional<double> ContactRecord::last_contact() const {
  return touched_ ? std::optional<double>(last_) : std::nullopt;
}

std::optional<double> ContactRecord::impulse_time(double fraction) const {
  assert(fraction > 0.0 && fraction <= 1.0);
  if (!touched_ || impulse_.y == 0.0) return std::nullopt;
  // Multiplying by the sign makes "reached" one comparison for an impulse up or down.
  const double sign = impulse_.y > 0.0 ? 1.0 : -1.0;
  const double target = fraction * sign * impulse_.y;
  Sample before = samples_.front();
  const auto reached = [&](const Sample& after) { return sign * after.vertical_impulse >= target; };
  const auto between = [&](const Sample& after) {
    const double low = sign * before.vertical_impulse, high = sign * after.vertical_impulse;
    return before.time + (after.time - before.time) * ((target - low) / (high - low));
  };
  for (const Sample& after : samples_) {
    if (reached(after)) return between(after);
    before = after;
  }
  return between({now_, impulse_.y});
}

std::vector<double> ContactRecord::to_numbers() const {
  std::vector<double> numbers{
      sample_interval_, gap_limit_, static_cast<double>(maximum_samples_), touched_ ? 1.0 : 0.0, first_, last_, now_,
      impulse_.x,       impulse_.y};
  numbers.reserve(numbers.size() + 2 + 2 * (gaps_.size() + samples_.size()));
  numbers.push_back(static_cast<double>(gaps_.size()));
  for (const Gap& gap : gaps_) {
    numbers.push_back(gap.start);
    numbers.push_back(gap.end);
  }
  numbers.push_back(static_cast<double>(samples_.size()));
  for (const Sample& sample : samples_) {
    numbers.push_back(sample.time);
    numbers.push_back(sample.vertical_impulse);
  }
  return numbers;
}

ContactRecord ContactRecord::from_numbers(std::span<const double> numbers) {
  NumberReader reader(numbers, "contact record");
  const double sample_interval = reader.number();
  const double gap_limit = reader.number();
  const double maximum_samples = reader.number();
  if (!(sample_interval > 0.0) || !(gap_limit >= 0.0) || !(maximum_samples >= 4.0 && maximum_samples < 1e9))
    reader.fail("holds impossible settings");
  ContactRecord record(sample_interval, gap_limit, static_cast<std::size_t>(maximum_samples));
  record.touched_ = reader.flag();
  record.first_ = reader.number();
  record.last_ = reader.number();
  record.now_ = reader.number();
  record.impulse_.x = reader.number();
  record.impulse_.y = reader.number();
  record.gaps_.resize(reader.count(2));
  for (Gap& gap : record.gaps_) {
    gap.start = reader.number();
    gap.end = reader.number();
  }
  const std::size_t samples = reader.count(2);
  if (samples > record.maximum_samples_ || record.touched_ == (samples == 0)) reader.fail("holds impossible samples");
  record.samples_.resize(samples);
  for (Sample& sample : record.samples_) {
    sample.time = reader.number();
    sample.vertical_impulse = reader.number();
  }
  reader.expect_end();
  return record;
}

}  // namespace sphdrop
