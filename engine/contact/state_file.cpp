// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/state_file.hpp"

#include <memory>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/hdf5_surface.hpp"
#include "engine/surface/io/xdmf.hpp"

namespace asperity {

namespace {

Hdf5Array field_array(const State& state, const std::string& name) {
  const std::shared_ptr<const Field> field = state.field(name);
  std::vector<std::size_t> shape{static_cast<std::size_t>(field->ny()),
                                 static_cast<std::size_t>(field->nx())};
  if (name == "contact") {
    Array<std::uint8_t> touching(field->size());
    for (std::size_t k = 0; k < touching.size(); ++k) touching[k] = (*field)[k] != 0 ? 1 : 0;
    return owning_array(name, std::move(shape), std::move(touching));
  }
  return {name, std::move(shape), field->values(), name == "pressure" ? "Pa" : "m", field};
}

}  // namespace

std::vector<std::string> fields_of(const State& state) {
  const auto names = State::field_names();
  std::vector<std::string> fields(names.begin(), names.end());
  if (!state.yields()) std::erase(fields, "plastic");
  return fields;
}

void write_state(const State& state, const std::filesystem::path& path, std::vector<std::string> fields) {
  const std::string extension = file_extension(path.string());
  if (extension != "h5" && extension != "hdf5")
    throw Error(ErrorCode::bad_file, "cannot write a state to " + file_name(path.string()),
                "its fields go into one HDF5 file: use .h5");
  if (fields.empty()) fields = fields_of(state);
  Hdf5Content content;
  content.texts = {{"content", "asperity state"},
                   {"digest", state.digest()},
                   {"solver", state.solver()},
                   {"units", "SI: load N, pressure Pa, approach m, area m^2, the certificate relative"}};
  const Certificate& c = state.certificate();
  content.numbers = {{"load", state.load()},
                     {"pressure", state.pressure()},
                     {"approach", state.approach()},
                     {"area", state.area()},
                     {"area_fraction", state.area_fraction()},
                     {"certificate", c.worst()},
                     {"certificate penetration", c.penetration},
                     {"certificate tension", c.tension},
                     {"certificate complementarity", c.complementarity},
                     {"certificate load", c.load},
                     {"certificate cap", c.cap},
                     {"certificate attraction", c.attraction}};
  if (state.overlap_fraction() < 1)
    content.numbers.emplace_back("overlap_fraction", state.overlap_fraction());
  for (const std::string& name : fields) content.arrays.push_back(field_array(state, name));
  content.arrays.push_back(tile_size(state.grid()));
  write_hdf5_and_xdmf(path, state.grid(), "state", content);
}

}  // namespace asperity
