#pragma once
// The interactions of the rows swept last, kept for the other particle of each pair.

#include <cstddef>
#include <cstdint>

#include "particles/pack.hpp"
#include "solid/hypoelastic/hypoelastic_pair.hpp"
#include "sph/pair_sharing.hpp"

namespace sphdrop {

/// For each slot of a PairSharing a ring of `rows` rows. A row's place in the ring is the row modulo its length; the
/// first block stands once more behind the last, so that any consecutive rows are one load.
template <std::int64_t rows>
class SharedInteractions {
  static_assert((rows & (rows - 1)) == 0 && rows >= std::int64_t{2} * block_size);

 public:
  static std::size_t size(std::int32_t slots) { return static_cast<std::size_t>(slots * slot_size); }

  /// In `values` there are as many as size() says.
  explicit SharedInteractions(double* values) : values_(values) {}

  /// Keeps the pairs of a pack of rows, which does not reach over the end of a block.
  [[gnu::always_inline]] void keep(std::int32_t slot, std::int64_t row,
                                   const HypoelasticInteraction<Pack>& pair) const {
    const std::int64_t place = row & (rows - 1);
    write(values_ + slot * slot_size + place, pair);
    if (place < block_size) write(values_ + slot * slot_size + place + rows, pair);
  }

  /// The pairs of any consecutive rows.
  [[gnu::always_inline]] HypoelasticInteraction<Pack> kept(std::int32_t slot, std::int64_t row) const {
    const double* p = values_ + slot * slot_size + (row & (rows - 1));
    HypoelasticInteraction<Pack> pair;
    pair.gradient_x = load(p);
    pair.gradient_y = load(p + stride);
    pair.velocity_dot_gradient = load(p + 2 * stride);
    pair.viscosity = load(p + 3 * stride);
    pair.weight = load(p + 4 * stride);
    pair.artificial_x = load(p + 5 * stride);
    pair.artificial_y = load(p + 6 * stride);
    return pair;
  }

 private:
  static constexpr std::int64_t stride = rows + block_size, quantities = 7, slot_size = quantities * stride;

  [[gnu::always_inline]] static void write(double* p, const HypoelasticInteraction<Pack>& pair) {
    store(pair.gradient_x, p);
    store(pair.gradient_y, p + stride);
    store(pair.velocity_dot_gradient, p + 2 * stride);
    store(pair.viscosity, p + 3 * stride);
    store(pair.weight, p + 4 * stride);
    store(pair.artificial_x, p + 5 * stride);
    store(pair.artificial_y, p + 6 * stride);
  }

  double* values_;  // [slot][quantity][place]
};

}  // namespace sphdrop
