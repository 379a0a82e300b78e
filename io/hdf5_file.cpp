#include "io/hdf5_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "io/collective_error.hpp"
#include "io/hdf5_call.hpp"

namespace sphdrop {
namespace {

void silence_error_printing() {
  static const herr_t once = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  static_cast<void>(once);
}

Hdf5Handle property_list(hid_t kind, const std::string& what) {
  return {checked(H5Pcreate(kind), "H5Pcreate", what), H5Pclose};
}

hid_t file_type_of(Hdf5Type type) {
  switch (type) {
    case Hdf5Type::float64:
      return H5T_IEEE_F64LE;
    case Hdf5Type::int64:
      return H5T_STD_I64LE;
    case Hdf5Type::uint64:
      return H5T_STD_U64LE;
    case Hdf5Type::uint8:
      return H5T_STD_U8LE;
  }
  std::abort();
}

hid_t memory_type_of(Hdf5Type type) {
  switch (type) {
    case Hdf5Type::float64:
      return H5T_NATIVE_DOUBLE;
    case Hdf5Type::int64:
      return H5T_NATIVE_INT64;
    case Hdf5Type::uint64:
      return H5T_NATIVE_UINT64;
    case Hdf5Type::uint8:
      return H5T_NATIVE_UINT8;
  }
  std::abort();
}

}  // namespace

std::size_t size_in_bytes(Hdf5Type type) {
  return type == Hdf5Type::uint8 ? 1 : 8;
}

Hdf5Handle::~Hdf5Handle() {
  if (is_open()) close_(identifier_);
}

Hdf5Handle::Hdf5Handle(Hdf5Handle&& other) noexcept : identifier_(other.release()), close_(other.close_) {}

Hdf5Handle& Hdf5Handle::operator=(Hdf5Handle&& other) noexcept {
  std::swap(identifier_, other.identifier_);
  std::swap(close_, other.close_);
  return *this;
}

hid_t Hdf5Handle::release() {
  return std::exchange(identifier_, H5I_INVALID_HID);
}

Hdf5Dataset::Hdf5Dataset(std::string name, Hdf5Handle dataset, Hdf5Type type, std::int64_t rows, int components)
    : name_(std::move(name)), dataset_(std::move(dataset)), type_(type), rows_(rows), components_(components) {}

Hdf5Handle Hdf5Dataset::memory_space(std::int64_t count) const {
  Hdf5Handle space = dataspace(std::max<std::int64_t>(count, 1), components_, name_);
  if (count == 0) checked(H5Sselect_none(space.get()), "H5Sselect_none", name_);
  return space;
}

Hdf5Handle Hdf5Dataset::file_space(std::int64_t first_row, std::int64_t count) const {
  if (first_row < 0 || count < 0 || first_row + count > rows_) {
    throw Hdf5Error(
        fmt::format("{}: rows {} to {} asked for, but there are {}", name_, first_row, first_row + count, rows_));
  }
  Hdf5Handle space(checked(H5Dget_space(dataset_.get()), "H5Dget_space", name_), H5Sclose);
  const std::array<hsize_t, 2> start = {static_cast<hsize_t>(first_row), 0};
  const std::array<hsize_t, 2> sizes = {static_cast<hsize_t>(count), static_cast<hsize_t>(components_)};
  if (count == 0) {
    checked(H5Sselect_none(space.get()), "H5Sselect_none", name_);
  } else {
    checked(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, sizes.data(), nullptr),
            "H5Sselect_hyperslab", name_);
  }
  return space;
}

void Hdf5Dataset::write_rows_collectively(std::int64_t first_row, std::int64_t count, const void* data) {
  const Hdf5Handle in_file = file_space(first_row, count);
  // A dataset without rows has no place in the file, which HDF5 takes for an error even of a rank that writes nothing.
  if (rows_ == 0) return;
  const Hdf5Handle in_memory = memory_space(count);
  const Hdf5Handle transfer = property_list(H5P_DATASET_XFER, name_);
  checked(H5Pset_dxpl_mpio(transfer.get(), H5FD_MPIO_COLLECTIVE), "H5Pset_dxpl_mpio", name_);
  checked(H5Dwrite(dataset_.get(), memory_type_of(type_), in_memory.get(), in_file.get(), transfer.get(), data),
          "H5Dwrite", name_);
}

void Hdf5Dataset::write_rows(std::int64_t first_row, std::int64_t count, const void* data) {
  const Hdf5Handle in_file = file_space(first_row, count);
  if (count == 0) return;
  const Hdf5Handle in_memory = memory_space(count);
  checked(H5Dwrite(dataset_.get(), memory_type_of(type_), in_memory.get(), in_file.get(), H5P_DEFAULT, data),
          "H5Dwrite", name_);
}

bool Hdf5Dataset::is_stored_as_opened() const {
  const Hdf5Handle type(checked(H5Dget_type(dataset_.get()), "H5Dget_type", name_), H5Tclose);
  return checked(H5Tequal(type.get(), file_type_of(type_)), "H5Tequal", name_) > 0;
}

void Hdf5Dataset::read_rows(std::int64_t first_row, std::int64_t count, void* data) const {
  const Hdf5Handle in_file = file_space(first_row, count);
  if (count == 0) return;
  const Hdf5Handle in_memory = memory_space(count);
  checked(H5Dread(dataset_.get(), memory_type_of(type_), in_memory.get(), in_file.get(), H5P_DEFAULT, data), "H5Dread",
          name_);
}

Hdf5File::Hdf5File(std::string path, Hdf5Handle file, MPI_Comm communicator)
    : path_(std::move(path)), file_(std::move(file)), communicator_(communicator) {}

Hdf5File Hdf5File::create(const std::string& path, std::int64_t user_block) {
  silence_error_printing();
  const Hdf5Handle creation = property_list(H5P_FILE_CREATE, path);
  checked(H5Pset_obj_track_times(creation.get(), false), "H5Pset_obj_track_times", path);
  checked(H5Pset_userblock(creation.get(), static_cast<hsize_t>(user_block)), "H5Pset_userblock", path);
  Hdf5Handle file(checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), H5P_DEFAULT), "H5Fcreate", path),
                  H5Fclose);
  return {path, std::move(file), MPI_COMM_NULL};
}

void Hdf5File::redirect(int descriptor) {
  void* own = nullptr;
  checked(H5Fget_vfd_handle(file_.get(), H5P_DEFAULT, &own), "H5Fget_vfd_handle", path_);
  if (::dup3(descriptor, *static_cast<const int*>(own), O_CLOEXEC) < 0)
    throw Hdf5Error(fmt::format("{}: dup3: {}", path_, std::generic_category().message(errno)));
}

Hdf5File Hdf5File::open_collectively(const Communicator& communicator, const std::string& path) {
  silence_error_printing();
  const Hdf5Handle access = property_list(H5P_FILE_ACCESS, path);
  checked(H5Pset_fapl_mpio(access.get(), communicator.handle(), MPI_INFO_NULL), "H5Pset_fapl_mpio", path);
  Hdf5Handle file(checked(H5Fopen(path.c_str(), H5F_ACC_RDWR, access.get()), "H5Fopen", path), H5Fclose);
  return {path, std::move(file), communicator.handle()};
}

Hdf5File Hdf5File::open_to_read(const std::string& path) {
  silence_error_printing();
  Hdf5Handle file(checked(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "H5Fopen", path), H5Fclose);
  return {path, std::move(file), MPI_COMM_NULL};
}

Hdf5File::~Hdf5File() {
  try {
    close();
  } catch (const Hdf5Error& error) {
    fmt::print(stderr, "warning: {}\n", error.what());
  }
}

void Hdf5File::close() {
  if (!file_.is_open()) return;
  const bool failed = H5Fclose(file_.release()) < 0;
  if (!failed) return;
  const std::string text = fmt::format("{}: H5Fclose failed: {}", path_, hdf5_error_text());
  if (communicator_ == MPI_COMM_NULL) throw Hdf5Error(text);
  fmt::print(stderr, "error: {}\nThe file is incomplete and MPI-IO in an undefined state; stopping.\n", text);
  std::fflush(stderr);
  MPI_Abort(communicator_, unwritable_output_exit_code);
}

std::string Hdf5File::describe(const std::string& object) const {
  return path_ + ":" + object;
}

void Hdf5File::create_group(const std::string& name) {
  const Hdf5Handle creation = property_list(H5P_GROUP_CREATE, describe(name));
  checked(H5Pset_obj_track_times(creation.get(), false), "H5Pset_obj_track_times", describe(name));
  const Hdf5Handle group(checked(H5Gcreate2(file_.get(), name.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
                                 "H5Gcreate", describe(name)),
                         H5Gclose);
}

Hdf5Dataset Hdf5File::create_dataset(const std::string& name, Hdf5Type type, std::int64_t rows, int components) {
  const std::string what = describe(name);
  const Hdf5Handle creation = property_list(H5P_DATASET_CREATE, what);
  checked(H5Pset_obj_track_times(creation.get(), false), "H5Pset_obj_track_times", what);
  checked(H5Pset_fill_time(creation.get(), H5D_FILL_TIME_NEVER), "H5Pset_fill_time", what);
  checked(H5Pset_alloc_time(creation.get(), H5D_ALLOC_TIME_EARLY), "H5Pset_alloc_time", what);
  const Hdf5Handle space = dataspace(rows, components, what);
  Hdf5Handle dataset(checked(H5Dcreate2(file_.get(), name.c_str(), file_type_of(type), space.get(), H5P_DEFAULT,
                                        creation.get(), H5P_DEFAULT),
                             "H5Dcreate", what),
                     H5Dclose);
  return {what, std::move(dataset), type, rows, components};
}

Hdf5Dataset Hdf5File::open_dataset(const std::string& name, Hdf5Type type) const {
  const std::string what = describe(name);
  Hdf5Handle dataset(checked(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT), "H5Dopen", what), H5Dclose);
  const Hdf5Handle space(checked(H5Dget_space(dataset.get()), "H5Dget_space", what), H5Sclose);
  const int rank = checked(H5Sget_simple_extent_ndims(space.get()), "H5Sget_simple_extent_ndims", what);
  if (rank != 1 && rank != 2) throw Hdf5Error(fmt::format("{}: has {} dimensions, not one or two", what, rank));
  std::array<hsize_t, 2> sizes = {0, 1};
  checked(H5Sget_simple_extent_dims(space.get(), sizes.data(), nullptr), "H5Sget_simple_extent_dims", what);
  return {what, std::move(dataset), type, static_cast<std::int64_t>(sizes[0]), static_cast<int>(sizes[1])};
}

}  // namespace sphdrop
