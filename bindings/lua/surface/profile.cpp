// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/surface/measure.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/metrology/levelling.hpp"
#include "engine/plot/picture.hpp"
#include "engine/surface/io/read.hpp"
#include "engine/surface/io/write.hpp"
#include "engine/surface/operations/operations.hpp"

namespace asperity::lua {

namespace {

Values positions(Call& call) {
  const Profile& p = call.self<Profile>();
  Array<double> x(static_cast<std::size_t>(p.size()));
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = static_cast<double>(k) * p.spacing();
  return {number_list(x)};
}

// About the centre of a closed outline.
Values outline(Call& call) {
  const Profile& p = call.self<Profile>();
  if (!p.closed()) refuse_state("the profile is not a closed outline", "grain_profile makes one");
  const auto h = p.measured_heights();
  Array<double> x(h.size()), y(h.size());
  for (std::size_t k = 0; k < h.size(); ++k) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(h.size());
    x[k] = (*p.closed_radius() + h[k]) * elementary::cos(angle);
    y[k] = (*p.closed_radius() + h[k]) * elementary::sin(angle);
  }
  return {number_list(x), number_list(y)};
}

Values filtered_profile(Call& call) {
  const GaussianFilter filter = call.options(filter_block);
  const Profile& profile = call.self<Profile>();
  Values result = {object(gaussian_filtered(profile, filter))};
  warn_of_empty_filter(call, filter, profile.length(), profile.spacing());
  return result;
}
struct ProfilePictureKeys {
  std::string title;
};
const Block<ProfilePictureKeys> profile_picture_block{
    {text("title", &ProfilePictureKeys::title, "above the picture")}};

Values write_profile(Call& call) {
  const Profile& profile = call.self<Profile>();
  const std::string path = writable_path(call, call.text(1, "path"));
  write_profile(profile, path, call.session().monitor());
  return {path};
}

const Block<ReadProfileOptions> read_profile_block{
    {quantity("spacing", &ReadProfileOptions::spacing, dimension::length, above(0),
              "distance between samples, where the file has none"),
     unit_key(&ReadProfileOptions::unit), unit_xy_key(&ReadProfileOptions::unit_xy),
     fill_key(&ReadProfileOptions::fill), format_key(&ReadProfileOptions::format),
     channel_key(&ReadProfileOptions::channel)}};

}  // namespace

// data table
Class make_class(For<Profile>) {
  Class c{"Profile", "a profile",
          "Heights at equal spacing along a line, or once around a closed outline; an immutable value."};
  c.describe = from_value([](const Profile& p) -> std::string {
    return (p.closed() ? "closed profile of " : "profile of ") + std::to_string(p.size()) + " samples, " +
           format_quantity(p.length(), dimension::length) + " long, peak to valley " +
           format_quantity(p.height_range().span(), dimension::length) +
           missing_text(p.measured(), static_cast<std::size_t>(p.size()));
  });
  c.native_bytes = from_value([](const Profile& p) { return p.measured_heights().size_bytes(); });
  c.equal = have_one_digest<Profile>;
  c.digest = text_of<&Profile::digest>;
  c.fields = {
      getter<&Profile::size>("points", "integer", "number of samples"),
      getter<&Profile::spacing>("spacing", "number", "distance between samples", dimension::length),
      getter<&Profile::length>("length", "number", "samples times spacing", dimension::length),
      getter<&Profile::closed_radius>("radius", "number",
                                      "of a closed outline, whose heights are r - radius; else nil",
                                      dimension::length),
      getter<&Profile::digest>("digest", "string", "equal profiles have equal digests"),
  };
  append(c.fields, missing_point_fields_of_profile());
  c.methods = {
      {.name = "heights",
       .body = method([](const Profile& p) { return p.measured_heights(); }),
       .sentence = "All heights in metres; nan at samples that were not measured.",
       .returns = "number[]",
       .example = "local z = p:heights()"},
      {.name = "positions",
       .body = positions,
       .sentence = "Positions of the samples along the profile in metres.",
       .returns = "number[]",
       .example = "local x = p:positions()"},
      {.name = "outline",
       .body = outline,
       .sentence = "x and y of the points of a closed outline: two tables, with nan for points not measured.",
       .returns = "number[], number[]",
       .example = "local x, y = grain:outline()"},
      {.name = "roughness",
       .body = method([](const Profile& p) { return profile_roughness_type(roughness(p)); }),
       .sentence = "Amplitude and slope statistics of the measured samples (ISO 21920-2), nothing levelled "
                   "or filtered first.",
       .returns = "Roughness",
       .example = "print(p:roughness().Ra)"},
      {.name = "spectrum",
       .body = method([](const Profile& p, Call& call) {
         return spectrum_type({spectrum(p, call.options(spectrum_block)), false});
       }),
       .sentence = "Power spectral density along the profile.",
       .options = optional(spectrum_block),
       .returns = "Spectrum",
       .example = "local c = p:spectrum().C"},
      {.name = "fractal_dimension",
       .body = method([](const Profile& p, Call& call) {
         return fractal_dimension_type(fractal_dimension(p, call.options(profile_fractal_dimension_block)));
       }),
       .sentence = "Fractal dimension of the profile.",
       .options = optional(profile_fractal_dimension_block),
       .returns = "FractalDimension",
       .example = "print(p:fractal_dimension{}.D)"},
      {.name = "filtered",
       .body = filtered_profile,
       .sentence = "ISO 16610-21 Gaussian filter.",
       .options = &filter_block,
       .returns = "Profile",
       .example = "p:filtered{ long_wave=\"0.8 mm\" }"},
      {.name = "levelled",
       .body =
           method([](const Profile& p, Call& call) { return levelled(p, call.options(level_block).degree); }),
       .sentence = "Less the least-squares polynomial of a degree.",
       .options = optional(level_block),
       .returns = "Profile",
       .example = "p:levelled()"},
      {.name = "cut",
       .body = method([](const Profile& p, Call& call) { return cut(p, call.options(cut_block).fraction); }),
       .sentence =
           "Heights above max - fraction * peak-to-valley brought down to it; the profile keeps its length.",
       .options = &cut_block,
       .returns = "Profile",
       .example = "p:cut{ fraction=0.2 }"},
      {.name = "picture",
       .body = [](Call& call) -> Values {
         const ProfilePictureKeys keys = call.options(profile_picture_block, 2);
         const std::string path = writable_path(call, call.text(1, "path"));
         warn_of(call, draw(call.self<Profile>(), keys.title, path));
         return {path};
       },
       .sentence = "A drawing of the profile, or of the shape of a closed outline: .svg, .png or .pdf.",
       .parameters = {{"path", "string", "under the run directory"}},
       .options = optional(profile_picture_block),
       .returns = "string",
       .example = "grain:picture \"grain.svg\"",
       .heavy = true},
      {.name = "write",
       .body = write_profile,
       .sentence = "Writes the profile: .csv, .txt or .npy by the extension of the path.",
       .parameters = {{"path", "string", "under the run directory"}},
       .returns = "string",
       .example = "p:write \"trace.csv\"",
       .heavy = true},
  };
  append(c.methods, missing_point_methods_of_profile(), profile_parameter_methods());
  c.results = {&profile_roughness_type, &spectrum_type, &fractal_dimension_type, &outliers_type(false)};
  append(c.results, profile_parameter_results());
  return c;
}

Module profile_module() {
  Module m{"lab.profile",
           "Profiles: stylus traces from files. Surfaces give others with s:profile and s:profiles."};
  m.functions = {
      {.name = "read",
       .body = read_file<read_profile_block, read_profile>,
       .sentence = "A stylus trace from a file: a profiler's CSV, NPY, or text with one or two columns.",
       .parameters = {{"path", "string", "the file"}},
       .options = optional(read_profile_block),
       .returns = "Profile",
       .example = "local trace = lab.profile.read \"scan.csv\"",
       .heavy = true}};
  return m;
}

}  // namespace asperity::lua
