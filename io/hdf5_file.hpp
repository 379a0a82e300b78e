#pragma once
// HDF5 behind RAII: collective files for values, serial ones for structure and reading. Every function throws Hdf5Error
// with the path, the failed call and HDF5's own words, which HDF5 is kept from printing.

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "decomposition/communicator.hpp"

namespace sphdrop {

class Hdf5Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Owns an HDF5 identifier of any kind.
class Hdf5Handle {
 public:
  using CloseFunction = herr_t (*)(hid_t);
  Hdf5Handle() = default;
  Hdf5Handle(hid_t identifier, CloseFunction close) : identifier_(identifier), close_(close) {}
  ~Hdf5Handle();
  Hdf5Handle(Hdf5Handle&& other) noexcept;
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept;
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;

  hid_t get() const { return identifier_; }
  bool is_open() const { return identifier_ >= 0; }
  /// Gives the identifier away: the caller closes it.
  hid_t release();

 private:
  hid_t identifier_ = H5I_INVALID_HID;
  CloseFunction close_ = nullptr;
};

/// Element types of datasets, little-endian in the file.
enum class Hdf5Type { float64, int64, uint64, uint8 };
std::size_t size_in_bytes(Hdf5Type type);

/// A dataset of shape [rows] or [rows, components].
class Hdf5Dataset {
 public:
  std::int64_t rows() const { return rows_; }
  int components() const { return components_; }

  /// Whether the file holds exactly the type it was opened with, so that nothing is converted.
  bool is_stored_as_opened() const;

  /// Collective. Writes this rank's `count` consecutive rows (zero is allowed) from `first_row` on, in one MPI-IO call.
  void write_rows_collectively(std::int64_t first_row, std::int64_t count, const void* data);
  /// Serially, by one rank: for small values of the structure.
  void write_rows(std::int64_t first_row, std::int64_t count, const void* data);
  void read_rows(std::int64_t first_row, std::int64_t count, void* data) const;

 private:
  friend class Hdf5File;
  Hdf5Dataset(std::string name, Hdf5Handle dataset, Hdf5Type type, std::int64_t rows, int components);
  Hdf5Handle memory_space(std::int64_t count) const;
  Hdf5Handle file_space(std::int64_t first_row, std::int64_t count) const;

  std::string name_;
  Hdf5Handle dataset_;
  Hdf5Type type_;
  std::int64_t rows_;
  int components_;
};

/// An HDF5 file. Objects in it are named by their full path ("/VTKHDF/Points"). Nothing that is written holds a date.
class Hdf5File {
 public:
  /// With the serial driver, by one rank; replaces the file. For the structure: groups, attributes, datasets without
  /// their values. The first `user_block` bytes (0 or a power of two from 512 on) are left to the caller.
  static Hdf5File create(const std::string& path, std::int64_t user_block = 0);
  /// Right after create(): whatever HDF5 writes goes to this open file instead, and nothing to the path.
  void redirect(int descriptor);
  /// Collective. To write values into existing datasets. The structure must stay as it is: with none of HDF5's own data
  /// to write but the superblock, which has its place on the disk, closing works even if the values did not fit.
  static Hdf5File open_collectively(const Communicator& communicator, const std::string& path);
  /// With the serial driver, by any one rank.
  static Hdf5File open_to_read(const std::string& path);

  Hdf5File(Hdf5File&&) noexcept = default;
  Hdf5File& operator=(Hdf5File&&) = delete;
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  ~Hdf5File();

  /// Collective for a collective file. If HDF5 reports that it cannot close such a file, MPI-IO is left in a state in
  /// which MPI_Finalize crashes, so that the program is ended by MPI_Abort, with a message.
  void close();

  void create_group(const std::string& name);
  /// `components` = 1 makes a one-dimensional dataset. Contiguous, its place in the file reserved at once, never
  /// filled.
  Hdf5Dataset create_dataset(const std::string& name, Hdf5Type type, std::int64_t rows, int components);
  /// To read as `type`; HDF5 converts.
  Hdf5Dataset open_dataset(const std::string& name, Hdf5Type type) const;

  /// The names of the groups and of the datasets in a group, ascending.
  std::vector<std::string> groups_in(const std::string& group) const;
  std::vector<std::string> datasets_in(const std::string& group) const;

  /// A dataset of one string of fixed length; the text must not contain null bytes.
  void write_text(const std::string& name, std::string_view text);
  std::string read_text(const std::string& name) const;

  void write_attribute(const std::string& object, const std::string& name, double value);
  void write_attribute(const std::string& object, const std::string& name, std::span<const std::int64_t> values);
  void write_attribute(const std::string& object, const std::string& name, std::int64_t value);
  /// As a string of fixed length, which VTK's reader wants.
  void write_attribute(const std::string& object, const std::string& name, std::string_view text);
  double read_real_attribute(const std::string& object, const std::string& name) const;
  std::int64_t read_integer_attribute(const std::string& object, const std::string& name) const;
  /// Of fixed length.
  std::string read_text_attribute(const std::string& object, const std::string& name) const;

 private:
  Hdf5File(std::string path, Hdf5Handle file, MPI_Comm communicator);
  void write_attribute(const std::string& object, const std::string& name, hid_t file_type, hid_t memory_type,
                       hid_t space, const void* value);
  std::vector<std::string> members(const std::string& group, H5O_type_t kind) const;
  Hdf5Handle open_attribute(const std::string& object, const std::string& name) const;
  std::string describe(const std::string& object) const;

  std::string path_;
  Hdf5Handle file_;
  MPI_Comm communicator_;  ///< MPI_COMM_NULL: opened with the serial driver
};

}  // namespace sphdrop
