#pragma once
// The interactions of the rows swept last, kept for the other particle of each pair.

#include <cstdint>

#include "particles/column.hpp"
#include "particles/pack.hpp"
#include "solid/hypoelastic/hypoelastic_pair.hpp"
#include "sph/pair_sharing.hpp"

namespace sphdrop {

/// For each slot of a PairSharing a ring of rows. A row's place in the ring is the row modulo its length; the first
/// block stands once more behind the last, so that any consecutive rows are one load.
class SharedInteractions {
 public:
  /// Room for what `sharing` keeps; what was kept is lost.
  void resize(const PairSharing& sharing) {
    rows_ = sharing.rows;
    const auto size = static_cast<std::size_t>(sharing.slot_count * quantities * (rows_ + block_size));
    if (values_.size() < size) values_.resize(size);
  }

  /// What a loop over pairs copies, so that its addresses stay in registers.
  class Places {
   public:
    Places(double* data, std::int64_t rows) : data_(data), mask_(rows - 1), stride_(rows + block_size) {}

    /// Keeps the pairs of a pack of rows, which does not reach over the end of a block.
    [[gnu::always_inline]] void keep(std::int32_t slot, std::int64_t row,
                                     const HypoelasticInteraction<Pack>& pair) const {
      const std::int64_t place = row & mask_;
      write(at(slot, place), pair);
      if (place < block_size) write(at(slot, place + mask_ + 1), pair);
    }

    /// The pairs of any consecutive rows.
    [[gnu::always_inline]] HypoelasticInteraction<Pack> kept(std::int32_t slot, std::int64_t row) const {
      const double* p = at(slot, row & mask_);
      const std::int64_t s = stride_;
      HypoelasticInteraction<Pack> pair;
      pair.velocity_x = load(p);
      pair.velocity_y = load(p + s);
      pair.gradient_x = load(p + 2 * s);
      pair.gradient_y = load(p + 3 * s);
      pair.velocity_dot_gradient = load(p + 4 * s);
      pair.viscosity = load(p + 5 * s);
      pair.weight = load(p + 6 * s);
      pair.stress = {load(p + 7 * s), load(p + 8 * s), load(p + 9 * s)};
      pair.artificial_x = load(p + 10 * s);
      pair.artificial_y = load(p + 11 * s);
      return pair;
    }

   private:
    double* at(std::int32_t slot, std::int64_t place) const { return data_ + slot * quantities * stride_ + place; }

    [[gnu::always_inline]] void write(double* p, const HypoelasticInteraction<Pack>& pair) const {
      const std::int64_t s = stride_;
      store(pair.velocity_x, p);
      store(pair.velocity_y, p + s);
      store(pair.gradient_x, p + 2 * s);
      store(pair.gradient_y, p + 3 * s);
      store(pair.velocity_dot_gradient, p + 4 * s);
      store(pair.viscosity, p + 5 * s);
      store(pair.weight, p + 6 * s);
      store(pair.stress.xx, p + 7 * s);
      store(pair.stress.yy, p + 8 * s);
      store(pair.stress.xy, p + 9 * s);
      store(pair.artificial_x, p + 10 * s);
      store(pair.artificial_y, p + 11 * s);
    }

    double* data_;
    std::int64_t mask_, stride_;
  };
  Places places() { return {values_.data(), rows_}; }

 private:
  static constexpr std::int64_t quantities = 12;

  std::int64_t rows_ = 0;
  Column<double> values_;  // [slot][quantity][place]
};

}  // namespace sphdrop
