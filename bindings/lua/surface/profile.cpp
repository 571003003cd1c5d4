// SPDX-License-Identifier: GPL-3.0-or-later
// lab.profile and the class of profiles.
#include <numbers>

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/surface/measure.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/metrology/levelling.hpp"
#include "engine/plot/picture_profile.hpp"
#include "engine/surface/io/read.hpp"
#include "engine/surface/io/write.hpp"
#include "engine/surface/operations/operations.hpp"

namespace asperity::lua {

namespace {

Value::Numbers profile_numbers(std::span<const double> values) {
  return std::make_shared<const Array<double>>(values.begin(), values.end());
}

Values heights_of_profile(Call& call) { return {profile_numbers(call.self<Profile>().measured_heights())}; }

Values positions(Call& call) {
  const Profile& p = call.self<Profile>();
  Array<double> x(static_cast<std::size_t>(p.size()));
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = static_cast<double>(k) * p.spacing();
  return {profile_numbers(x)};
}

// Coordinates of a closed outline about its centre.
Values outline(Call& call) {
  const Profile& p = call.self<Profile>();
  if (!p.closed())
    throw Error(ErrorCode::bad_state, "the profile is not a closed outline", "grain_profile makes one");
  const auto h = p.measured_heights();
  Array<double> x(h.size()), y(h.size());
  for (std::size_t k = 0; k < h.size(); ++k) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(h.size());
    x[k] = (*p.closed_radius() + h[k]) * elementary::cos(angle);
    y[k] = (*p.closed_radius() + h[k]) * elementary::sin(angle);
  }
  return {profile_numbers(x), profile_numbers(y)};
}

Values roughness_of_profile(Call& call) { return {roughness_type(false)(roughness(call.self<Profile>()))}; }
Values spectrum_of_profile(Call& call) {
  return {spectrum_type()({spectrum(call.self<Profile>(), call.options(spectrum_block())), false})};
}
Values fractal_dimension_of_profile(Call& call) {
  return {fractal_dimension_type()(
      fractal_dimension(call.self<Profile>(), call.options(fractal_dimension_block(false))))};
}
Values filtered_profile(Call& call) {
  const GaussianFilter filter = call.options(filter_block());
  const Profile& profile = call.self<Profile>();
  Values result = {object(gaussian_filtered(profile, filter))};
  warn_of_empty_filter(call, filter, profile.length(), profile.spacing());
  return result;
}
Values level_profile(Call& call) {
  return {object(levelled(call.self<Profile>(), call.options(level_block()).degree))};
}

Values cut_off_profile(Call& call) {
  return {object(cut(call.self<Profile>(), call.options(cut_block()).fraction))};
}

struct ProfilePictureKeys {
  std::string title;
};
const Block<ProfilePictureKeys>& profile_picture_block() {
  static const Block<ProfilePictureKeys> block{
      "picture", {text("title", &ProfilePictureKeys::title, "above the picture")}};
  return block;
}
Values picture_of_profile(Call& call) {
  const ProfilePictureKeys keys = call.options(profile_picture_block(), 2);
  const std::string path = writable_path(call, call.text(1, "path"));
  warn_of(call, draw(call.self<Profile>(), keys.title, path));
  return {path};
}

Values write_profile(Call& call) {
  const Profile& profile = call.self<Profile>();
  const std::string path = writable_path(call, call.text(1, "path"));
  write_profile(profile, path, call.session().monitor());
  return {path};
}

const Block<ReadProfileOptions>& read_profile_block() {
  using O = ReadProfileOptions;
  static const Block<O> block{"lab.profile.read",
                              {quantity("spacing", &O::spacing, dimension::length, above(0),
                                        "distance between samples, where the file has none"),
                               unit_key(&O::unit), unit_xy_key(&O::unit_xy), fill_key(&O::fill),
                               format_key(&O::format), channel_key(&O::channel)}};
  return block;
}

Values read_profile_file(Call& call) {
  const std::string path = readable_path(call, call.text(1, "path"));
  const ReadProfileOptions options = call.options(read_profile_block(), 2);
  // The size check precedes the digest, so that a file too large for memory is not read.
  const SourceFile file(path, call.session().monitor());
  note_input(call, path);
  return {object(read_profile(file, options, call.session().monitor()))};
}

std::string describe_profile(const void* self) {
  const auto& p = *static_cast<const Profile*>(self);
  return (p.closed() ? "closed profile of " : "profile of ") + std::to_string(p.size()) + " samples, " +
         format_quantity(p.length(), dimension::length) + " long, peak to valley " +
         format_quantity(p.height_range().span(), dimension::length) +
         missing_text(p.measured(), static_cast<std::size_t>(p.size()));
}
std::size_t bytes_of_profile(const void* self) {
  return static_cast<const Profile*>(self)->measured_heights().size_bytes();
}

}  // namespace

// data table
template <>
const Class& class_of<Profile>() {
  static const Class type = [] {
    Class c;
    c.name = "Profile";
    c.article_name = "a profile";
    c.sentence =
        "Heights at equal spacing along a line, or once around a closed outline; an immutable value.";
    c.describe = describe_profile;
    c.native_bytes = bytes_of_profile;
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
    for (Getter& field : missing_point_fields_of_profile()) c.fields.push_back(std::move(field));
    c.methods = {
        {.name = "heights",
         .body = heights_of_profile,
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
         .sentence =
             "x and y of the points of a closed outline: two tables, with nan for points not measured.",
         .returns = "number[], number[]",
         .example = "local x, y = grain:outline()"},
        {.name = "roughness",
         .body = roughness_of_profile,
         .sentence = "Amplitude and slope statistics of the measured samples (ISO 21920-2), nothing levelled "
                     "or filtered first.",
         .returns = "Roughness",
         .example = "print(p:roughness().Ra)"},
        {.name = "spectrum",
         .body = spectrum_of_profile,
         .sentence = "Power spectral density along the profile.",
         .options = &spectrum_block(),
         .options_optional = true,
         .returns = "Spectrum",
         .example = "local c = p:spectrum().C"},
        {.name = "fractal_dimension",
         .body = fractal_dimension_of_profile,
         .sentence = "Fractal dimension of the profile.",
         .options = &fractal_dimension_block(false),
         .options_optional = true,
         .returns = "FractalDimension",
         .example = "print(p:fractal_dimension{}.D)"},
        {.name = "filtered",
         .body = filtered_profile,
         .sentence = "ISO 16610-21 Gaussian filter.",
         .options = &filter_block(),
         .returns = "Profile",
         .example = "p:filtered{ long_wave=\"0.8 mm\" }"},
        {.name = "levelled",
         .body = level_profile,
         .sentence = "Less the least-squares polynomial of a degree.",
         .options = &level_block(),
         .options_optional = true,
         .returns = "Profile",
         .example = "p:levelled()"},
        {.name = "cut",
         .body = cut_off_profile,
         .sentence = "Heights above max - fraction * peak-to-valley brought down to it; the profile keeps "
                     "its length.",
         .options = &cut_block(),
         .returns = "Profile",
         .example = "p:cut{ fraction=0.2 }"},
        {.name = "picture",
         .body = picture_of_profile,
         .sentence = "A drawing of the profile, or of the shape of a closed outline: .svg, .png or .pdf.",
         .parameters = {{"path", "string", "under the run directory"}},
         .options = &profile_picture_block(),
         .options_optional = true,
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
    for (Function& method : missing_point_methods_of_profile()) c.methods.push_back(std::move(method));
    c.methods.push_back(profile_parameters_method());
    c.methods.push_back(primary_parameters_method());
    c.methods.push_back(profile_bearing_method());
    c.results = {&roughness_type(false),       &spectrum_type(),
                 &fractal_dimension_type(),    &outliers_type(false),
                 &profile_parameters_result(), &primary_parameters_result()};
    return c;
  }();
  return type;
}

const Module& profile_module() {
  static const Module module = [] {
    Module m;
    m.path = "lab.profile";
    m.sentence = "Profiles: stylus traces from files. Surfaces give others with s:profile and s:profiles.";
    m.functions = {
        {.name = "read",
         .body = read_profile_file,
         .sentence = "A stylus trace from a file: a profiler's CSV, NPY, or text of one or two columns.",
         .parameters = {{"path", "string", "the file"}},
         .options = &read_profile_block(),
         .options_optional = true,
         .returns = "Profile",
         .example = "local trace = lab.profile.read \"scan.csv\"",
         .heavy = true}};
    return m;
  }();
  return module;
}

}  // namespace asperity::lua
