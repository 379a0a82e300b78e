#pragma once
// One number per row, aligned for vector loads and padded on both sides.

#include <cstddef>
#include <cstdlib>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace sphdrop {

/// Rows before the first and after the last that may be read (not meaningfully): a block of consecutive rows may start
/// or end beyond the array by less than a vector.
inline constexpr std::size_t column_padding = 16;

/// Allocates on cache-line boundaries.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U>
  explicit CacheLineAllocator(const CacheLineAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{64})); }
  void deallocate(T* p, std::size_t) { ::operator delete (p, std::align_val_t{64}); }
  template <class U>
  bool operator==(const CacheLineAllocator<U>&) const {
    return true;
  }
};

/// A resizable array of 8-byte elements with `column_padding` readable elements on either side, set to `padding_value`.
template <class T>
class Column {
  static_assert(sizeof(T) == 8 && std::is_trivially_copyable_v<T>, "columns travel between ranks as 8-byte words");

 public:
  explicit Column(T padding_value = T{}) : padding_value_(padding_value), storage_(2 * column_padding, padding_value) {}

  std::size_t size() const { return storage_.size() - 2 * column_padding; }
  T* data() { return storage_.data() + column_padding; }
  const T* data() const { return storage_.data() + column_padding; }
  T& operator[](std::size_t row) { return data()[row]; }
  const T& operator[](std::size_t row) const { return data()[row]; }
  T* begin() { return data(); }
  T* end() { return data() + size(); }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size(); }

  /// Keeps the rows that remain; new rows hold T{}.
  void resize(std::size_t rows) {
    const std::size_t kept = size() < rows ? size() : rows;
    storage_.resize(rows + 2 * column_padding);
    for (std::size_t row = kept; row < rows; ++row) data()[row] = T{};
    for (std::size_t k = 0; k < column_padding; ++k) data()[rows + k] = padding_value_;
  }
  void swap(Column& other) {
    std::swap(padding_value_, other.padding_value_);
    storage_.swap(other.storage_);
  }

 private:
  T padding_value_;
  std::vector<T, CacheLineAllocator<T>> storage_;
};

}  // namespace sphdrop
