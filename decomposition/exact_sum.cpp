#include "decomposition/exact_sum.hpp"

#include <bit>
#include <limits>
#include <vector>

namespace sphdrop {
namespace {

constexpr int limb_bits = 32;
constexpr std::int64_t limb_mask = 0xffffffff;
/// Two sums at this limit added together stay below 2^62 + 2^34 in every limb.
constexpr std::int64_t carry_limit = std::int64_t{1} << 28;
constexpr int mantissa_bits = 52;

}  // namespace

void ExactSum::add(double term) {
  const auto bits = std::bit_cast<std::uint64_t>(term);
  const auto exponent = static_cast<unsigned>(bits >> mantissa_bits) & 0x7ffU;
  if (exponent == 0x7ffU) {
    ++not_finite_;
    return;
  }
  if (carries_ >= carry_limit) normalise();
  const std::uint64_t fraction = bits & ((std::uint64_t{1} << mantissa_bits) - 1);
  const std::uint64_t mantissa = exponent == 0 ? fraction : fraction | (std::uint64_t{1} << mantissa_bits);
  const unsigned shift = exponent == 0 ? 0 : exponent - 1;  // the term is mantissa * 2^(shift - 1074)

  const unsigned offset = shift % limb_bits;
  const auto low = static_cast<std::int64_t>((mantissa & limb_mask) << offset);
  const auto high = static_cast<std::int64_t>((mantissa >> limb_bits) << offset);
  const std::int64_t sign = -static_cast<std::int64_t>(bits >> 63);
  const auto with_sign = [sign](std::int64_t v) { return (v ^ sign) - sign; };
  std::int64_t* limb = &limbs_[shift / limb_bits];
  limb[0] += with_sign(low & limb_mask);
  limb[1] += with_sign((low >> limb_bits) + (high & limb_mask));
  limb[2] += with_sign(high >> limb_bits);
  ++carries_;
}

void ExactSum::add(const ExactSum& other) {
  const std::int64_t carries = carries_ + other.carries_ + 1;
  not_finite_ += other.not_finite_;
  for (std::size_t k = 0; k < limb_count; ++k) limbs_[k] += other.limbs_[k];
  carries_ = carries;
  if (carries_ >= carry_limit) normalise();
}

void ExactSum::normalise() {
  for (std::size_t k = 0; k + 1 < limb_count; ++k) {
    limbs_[k + 1] += limbs_[k] >> limb_bits;
    limbs_[k] &= limb_mask;
  }
  carries_ = 0;
}

void ExactSum::reduce(std::span<ExactSum> sums, const Communicator& communicator) {
  constexpr std::size_t words = limb_count + 1;
  std::vector<std::int64_t> buffer;
  buffer.reserve(sums.size() * words);
  for (ExactSum& sum : sums) {
    sum.normalise();  // limbs of 32 bits leave 31 for the ranks
    buffer.insert(buffer.end(), sum.limbs_.begin(), sum.limbs_.end());
    buffer.push_back(sum.not_finite_);
  }
  communicator.sum_in_place(buffer);
  const std::int64_t* word = buffer.data();
  for (ExactSum& sum : sums) {
    for (std::int64_t& limb : sum.limbs_) limb = *word++;
    sum.not_finite_ = *word++;
    sum.normalise();
  }
}

double ExactSum::value() const {
  if (not_finite_ != 0) return std::numeric_limits<double>::quiet_NaN();
  ExactSum magnitude = *this;
  magnitude.normalise();
  const bool negative = magnitude.limbs_.back() < 0;
  if (negative) {
    for (std::int64_t& limb : magnitude.limbs_) limb = -limb;
    magnitude.normalise();
  }
  const auto& limbs = magnitude.limbs_;
  std::size_t top = limb_count;
  while (top > 0 && limbs[top - 1] == 0) --top;
  if (top == 0) return 0.0;
  --top;

  // Units of 2^-1074 from here on. Bits of the leading limb and below, as far as a mantissa and its rounding bit reach.
  const auto limb = [&limbs](std::size_t k) { return static_cast<std::uint64_t>(limbs[k]); };
  const int leading_bit = static_cast<int>(top) * limb_bits + static_cast<int>(std::bit_width(limb(top))) - 1;
  const int shift = leading_bit > mantissa_bits ? leading_bit - mantissa_bits : 0;
  const auto bit = [&limb](int k) { return (limb(static_cast<std::size_t>(k / limb_bits)) >> (k % limb_bits)) & 1U; };
  const auto largest = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::max());
  if (shift >= static_cast<int>(largest >> mantissa_bits))
    return negative ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();

  std::uint64_t mantissa = 0;
  for (int k = shift + mantissa_bits; k >= shift; --k) mantissa = mantissa << 1 | bit(k);
  if (shift > 0 && bit(shift - 1) != 0) {
    const auto cut = static_cast<std::size_t>((shift - 1) / limb_bits);
    const int below = (shift - 1) % limb_bits;
    bool sticky = (limb(cut) & ((std::uint64_t{1} << below) - 1)) != 0;
    for (std::size_t k = 0; k < cut; ++k) sticky = sticky || limbs[k] != 0;
    if (sticky || (mantissa & 1U) != 0) ++mantissa;
  }
  // The leading bit of the mantissa is that of the exponent field too: it turns `shift` into the biased exponent,
  // leaves a subnormal as it is, carries a rounded-up mantissa into the next binade and the largest double into
  // infinity.
  const std::uint64_t magnitude_bits = (static_cast<std::uint64_t>(shift) << mantissa_bits) + mantissa;
  return std::bit_cast<double>(magnitude_bits | static_cast<std::uint64_t>(negative) << 63);
}

}  // namespace sphdrop
