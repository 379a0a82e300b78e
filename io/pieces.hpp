#pragma once
// A column's values where they lie, one piece behind the other, so that writing them needs no copy of the whole.

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace sphdrop {

/// Shape [n]. Refers to the values, which must outlive it; a piece may also be one value many times.
template <class T>
class Pieces {
  static_assert(sizeof(T) == 8 && std::is_trivially_copyable_v<T>, "columns travel between ranks as 8-byte words");

 public:
  Pieces() = default;
  // One piece is what most columns are.
  Pieces(std::span<const T> values) { add(values); }
  Pieces(const std::vector<T>& values) { add(values); }
  Pieces(std::vector<T>&&) = delete;

  void add(std::span<const T> values) {
    if (!values.empty()) append({values.data(), T{}, values.size()});
  }
  void add_constant(T value, std::size_t count) {
    if (count > 0) append({nullptr, value, count});
  }

  std::size_t size() const { return size_; }

  /// Calls f(row, value) for all rows, ascending.
  template <class F>
  void for_each(F&& f) const {
    std::size_t row = 0;
    for (const Piece& piece : pieces_)
      for (std::size_t k = 0; k < piece.count; ++k) f(row++, piece.at(k));
  }

  /// A copy of all of them.
  std::vector<T> joined() const {
    std::vector<T> values;
    values.reserve(size_);
    for_each([&](std::size_t, T value) { values.push_back(value); });
    return values;
  }

  /// The values of `rows` one behind the other, 8 bytes each. Quick where rows ascend.
  void copy(std::span<const std::int32_t> rows, std::byte* to) const {
    std::size_t which = 0, begin = 0;
    for (const std::int32_t signed_row : rows) {
      const auto row = static_cast<std::size_t>(signed_row);
      assert(row < size_);
      if (row < begin) which = begin = 0;
      while (row >= begin + pieces_[which].count) begin += pieces_[which++].count;
      const T value = pieces_[which].at(row - begin);
      std::memcpy(to, &value, sizeof(T));
      to += sizeof(T);
    }
  }

 private:
  struct Piece {
    const T* values;  ///< nullptr: all are `constant`
    T constant;
    std::size_t count;
    T at(std::size_t k) const { return values == nullptr ? constant : values[k]; }
  };
  void append(const Piece& piece) {
    pieces_.push_back(piece);
    size_ += piece.count;
  }

  std::vector<Piece> pieces_;  ///< none is empty
  std::size_t size_ = 0;
};

}  // namespace sphdrop
