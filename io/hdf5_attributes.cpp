#include <fmt/format.h>

#include <algorithm>

#include "io/hdf5_call.hpp"
#include "io/hdf5_file.hpp"

namespace sphdrop {

void Hdf5File::write_attribute(const std::string& object, const std::string& name, hid_t file_type, hid_t memory_type,
                               hid_t space, const void* value) {
  const std::string what = fmt::format("{}, attribute {}", describe(object), name);
  const Hdf5Handle attribute(checked(H5Acreate_by_name(file_.get(), object.c_str(), name.c_str(), file_type, space,
                                                       H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                                     "H5Acreate", what),
                             H5Aclose);
  checked(H5Awrite(attribute.get(), memory_type, value), "H5Awrite", what);
}

void Hdf5File::write_attribute(const std::string& object, const std::string& name, double value) {
  const Hdf5Handle scalar(checked(H5Screate(H5S_SCALAR), "H5Screate", describe(object)), H5Sclose);
  write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, scalar.get(), &value);
}

void Hdf5File::write_attribute(const std::string& object, const std::string& name,
                               std::span<const std::int64_t> values) {
  const Hdf5Handle space = dataspace(std::ssize(values), 1, describe(object));
  write_attribute(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, space.get(), values.data());
}

void Hdf5File::write_attribute(const std::string& object, const std::string& name, std::int64_t value) {
  const Hdf5Handle scalar(checked(H5Screate(H5S_SCALAR), "H5Screate", describe(object)), H5Sclose);
  write_attribute(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, scalar.get(), &value);
}

void Hdf5File::write_attribute(const std::string& object, const std::string& name, std::string_view text) {
  const PaddedText padded(text, describe(object));
  const Hdf5Handle scalar(checked(H5Screate(H5S_SCALAR), "H5Screate", describe(object)), H5Sclose);
  write_attribute(object, name, padded.type(), padded.type(), scalar.get(), padded.data());
}

Hdf5Handle Hdf5File::open_attribute(const std::string& object, const std::string& name) const {
  const std::string what = fmt::format("{}, attribute {}", describe(object), name);
  Hdf5Handle attribute(
      checked(H5Aopen_by_name(file_.get(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), "H5Aopen", what),
      H5Aclose);
  const Hdf5Handle space(checked(H5Aget_space(attribute.get()), "H5Aget_space", what), H5Sclose);
  if (H5Sget_simple_extent_npoints(space.get()) != 1) throw Hdf5Error(what + ": holds more than one value");
  return attribute;
}

double Hdf5File::read_real_attribute(const std::string& object, const std::string& name) const {
  double value = 0;
  checked(H5Aread(open_attribute(object, name).get(), H5T_NATIVE_DOUBLE, &value), "H5Aread", describe(object));
  return value;
}

std::int64_t Hdf5File::read_integer_attribute(const std::string& object, const std::string& name) const {
  std::int64_t value = 0;
  checked(H5Aread(open_attribute(object, name).get(), H5T_NATIVE_INT64, &value), "H5Aread", describe(object));
  return value;
}

std::string Hdf5File::read_text_attribute(const std::string& object, const std::string& name) const {
  const Hdf5Handle attribute = open_attribute(object, name);
  const Hdf5Handle type(checked(H5Aget_type(attribute.get()), "H5Aget_type", describe(object)), H5Tclose);
  std::string text(fixed_text_size(type.get(), fmt::format("{}, attribute {}", describe(object), name)), '\0');
  checked(H5Aread(attribute.get(), type.get(), text.data()), "H5Aread", describe(object));
  text.resize(std::min(text.size(), text.find('\0')));
  return text;
}

}  // namespace sphdrop
