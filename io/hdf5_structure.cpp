#include <fmt/format.h>

#include <algorithm>

#include "io/hdf5_call.hpp"
#include "io/hdf5_file.hpp"

namespace sphdrop {

std::vector<std::string> Hdf5File::members(const std::string& group, H5O_type_t kind) const {
  const std::string what = describe(group);
  const Hdf5Handle opened(checked(H5Gopen2(file_.get(), group.c_str(), H5P_DEFAULT), "H5Gopen", what), H5Gclose);
  H5G_info_t content = {};
  checked(H5Gget_info(opened.get(), &content), "H5Gget_info", what);
  std::vector<std::string> names;
  for (hsize_t number = 0; number < content.nlinks; ++number) {
    const auto name_of = [&](char* name, std::size_t size) {
      return checked(H5Lget_name_by_idx(opened.get(), ".", H5_INDEX_NAME, H5_ITER_INC, number, name, size, H5P_DEFAULT),
                     "H5Lget_name_by_idx", what);
    };
    std::string name(static_cast<std::size_t>(name_of(nullptr, 0)) + 1, '\0');
    name_of(name.data(), name.size());
    name.pop_back();
    H5O_info_t object = {};
    checked(H5Oget_info_by_name2(opened.get(), name.c_str(), &object, H5O_INFO_BASIC, H5P_DEFAULT), "H5Oget_info",
            fmt::format("{}/{}", what, name));
    if (object.type == kind) names.push_back(std::move(name));
  }
  return names;
}

std::vector<std::string> Hdf5File::groups_in(const std::string& group) const {
  return members(group, H5O_TYPE_GROUP);
}

std::vector<std::string> Hdf5File::datasets_in(const std::string& group) const {
  return members(group, H5O_TYPE_DATASET);
}

void Hdf5File::write_text(const std::string& name, std::string_view text) {
  const std::string what = describe(name);
  const PaddedText padded(text, what);
  const Hdf5Handle creation(checked(H5Pcreate(H5P_DATASET_CREATE), "H5Pcreate", what), H5Pclose);
  checked(H5Pset_obj_track_times(creation.get(), false), "H5Pset_obj_track_times", what);
  const Hdf5Handle scalar(checked(H5Screate(H5S_SCALAR), "H5Screate", what), H5Sclose);
  const Hdf5Handle dataset(checked(H5Dcreate2(file_.get(), name.c_str(), padded.type(), scalar.get(), H5P_DEFAULT,
                                              creation.get(), H5P_DEFAULT),
                                   "H5Dcreate", what),
                           H5Dclose);
  checked(H5Dwrite(dataset.get(), padded.type(), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()), "H5Dwrite", what);
}

std::string Hdf5File::read_text(const std::string& name) const {
  const std::string what = describe(name);
  const Hdf5Handle dataset(checked(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT), "H5Dopen", what), H5Dclose);
  const Hdf5Handle space(checked(H5Dget_space(dataset.get()), "H5Dget_space", what), H5Sclose);
  if (H5Sget_simple_extent_npoints(space.get()) != 1) throw Hdf5Error(what + ": holds more than one text");
  const Hdf5Handle type(checked(H5Dget_type(dataset.get()), "H5Dget_type", what), H5Tclose);
  std::string text(fixed_text_size(type.get(), what), '\0');
  checked(H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), "H5Dread", what);
  text.resize(std::min(text.size(), text.find('\0')));
  return text;
}

}  // namespace sphdrop
