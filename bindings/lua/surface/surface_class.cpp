// SPDX-License-Identifier: GPL-3.0-or-later
// Fields of a surface and the methods that measure and write. surface_operations.cpp has the methods that
// return surfaces and profiles.
#include <algorithm>

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/surface/field_class.hpp"
#include "bindings/lua/surface/known_body.hpp"
#include "bindings/lua/surface/measure.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/metrology/levelling.hpp"
#include "engine/surface/io/write.hpp"
#include "engine/surface/io/xdmf.hpp"

namespace asperity::lua {

namespace {

Values surface_height(Call& call) {
  return {call.self<Surface>().height(call.number(1, "i"), call.number(2, "j"))};
}

Values heights(Call& call) {
  const Surface surface = call.self<Surface>();
  // The pointer to the field shares ownership of the surface.
  auto holder = std::make_shared<const Surface>(surface);
  return {Value::Rows(holder, &holder->measured_heights())};
}

Values roughness_of(Call& call) { return {roughness_type(true)(roughness(call.self<Surface>()))}; }

Values spectrum_of(Call& call) {
  return {spectrum_type()({spectrum(call.self<Surface>(), call.options(spectrum_block())), true})};
}

Values fractal_dimension_of(Call& call) {
  return {fractal_dimension_type()(
      fractal_dimension(call.self<Surface>(), call.options(fractal_dimension_block(true))))};
}

Values filtered(Call& call) {
  const GaussianFilter filter = call.options(filter_block());
  const Surface& surface = call.self<Surface>();
  const Grid& grid = surface.grid();
  Values result = {object(gaussian_filtered(surface, filter))};
  warn_of_empty_filter(call, filter, std::max(grid.size_x, grid.size_y), std::min(grid.hx(), grid.hy()));
  return result;
}
Values level(Call& call) {
  return {object(levelled(call.self<Surface>(), call.options(level_block()).degree))};
}

Values write_surface(Call& call) {
  const std::string name = call.text(1, "path");
  const std::string path = writable_path(call, name);
  if (has_xdmf_beside(path)) writable_path(call, xdmf_path(name).string());
  write_surface(call.self<Surface>(), path, call.session().monitor());
  return {path};
}

Values picture(Call& call) {
  const PictureOptions options = call.options(picture_block(), 2);
  const std::string path = writable_path(call, call.text(1, "path"));
  warn_of(call, draw(call.self<Surface>(), options, path));
  return {path};
}

std::string describe_surface(const void* self) {
  const auto& s = *static_cast<const Surface*>(self);
  const Grid& g = s.grid();
  std::string text = "surface " + std::to_string(g.nx) + " x " + std::to_string(g.ny) + " cells, " +
                     format_quantity(g.size_x, dimension::length) + " x " +
                     format_quantity(g.size_y, dimension::length) + ", peak to valley " +
                     format_quantity(s.peak_to_valley(), dimension::length);
  text += missing_text(s.measured(), g.nodes());
  if (s.material()) text += ", " + s.material()->name;
  return text;
}

std::size_t bytes_of_surface(const void* self) {
  return static_cast<const Surface*>(self)->measured_heights().size() * sizeof(double);
}

}  // namespace

// data table
template <>
const Class& class_of<Surface>() {
  static const Class type = [] {
    Class c;
    c.name = "Surface";
    c.article_name = "a surface";
    c.sentence = "Heights on a regular grid of cells; an immutable value whose methods return new ones.";
    c.describe = describe_surface;
    c.native_bytes = bytes_of_surface;
    c.equal = have_one_digest<Surface>;
    c.digest = text_of<&Surface::digest>;
    c.known = known_result;
    c.fields = {
        getter<Surface>("cells", "{nx, ny}", "cells along x and y",
                        [](const Surface& of) {
                          return List{{of.grid().nx, of.grid().ny}};
                        }),
        getter<Surface>(
            "size", "{number, number}", "length along x and y",
            [](const Surface& of) {
              return List{{of.grid().size_x, of.grid().size_y}};
            },
            dimension::length),
        getter<Surface>(
            "material", "Material", "what the body is made of, or nil",
            [](const Surface& of) { return of.material() ? Value(object(*of.material())) : Value(); }),
        getter<Surface>("periodic", "boolean", "whether the heights continue smoothly across the rim",
                        [](const Surface& of) { return of.traits().periodic; }),
        getter<Surface>("aliased_share", "number",
                        "share of the variance past Nyquist; nil where it is not known",
                        [](const Surface& of) { return of.traits().aliased_share; }),
        getter<&Surface::peak_to_valley>("peak_to_valley", "number", "greatest less least height",
                                         dimension::length),
        getter<&Surface::digest>("digest", "string",
                                 "of grid, heights and holes: equal surfaces have equal digests"),
    };
    for (Getter& field : missing_point_fields_of_surface()) c.fields.push_back(std::move(field));
    c.operators = surface_operators();
    c.methods = {
        {.name = "height",
         .body = surface_height,
         .sentence = "Height of node (i, j) in metres, counted from 0; nan where it was not measured.",
         .parameters = {{"i", "integer", "along x"}, {"j", "integer", "along y"}},
         .returns = "number",
         .example = "s:height(0, 0)"},
        {.name = "heights",
         .body = heights,
         .sentence =
             "All heights as a table of rows, heights[j+1][i+1]; nan at points that were not measured.",
         .returns = "number[][]",
         .example = "local h = s:heights()"},
        {.name = "roughness",
         .body = roughness_of,
         .sentence =
             "Amplitude and slope statistics of all measured nodes (ISO 25178-2), nothing levelled or "
             "filtered first. Its amplitude is peak to valley; that of lab.surface.sine is half of it.",
         .returns = "ArealRoughness",
         .example = "print(s:roughness().Ra)"},
        {.name = "spectrum",
         .body = spectrum_of,
         .sentence = "Radially averaged power spectral density; points that were not measured are set to the "
                     "mean, which takes from its power and adds rims.",
         .options = &spectrum_block(),
         .options_optional = true,
         .returns = "Spectrum",
         .example = "local c = s:spectrum().C"},
        {.name = "fractal_dimension",
         .body = fractal_dimension_of,
         .sentence = "Fractal dimension of the profiles of the surface, with its scatter over them.",
         .options = &fractal_dimension_block(true),
         .options_optional = true,
         .returns = "FractalDimension",
         .example = "print(s:fractal_dimension{ method=\"structure\" }.D)"},
        {.name = "filtered",
         .body = filtered,
         .sentence = "ISO 16610 Gaussian filter; points that were not measured have no weight and stay so.",
         .options = &filter_block(),
         .returns = "Surface",
         .example = "s:filtered{ short_wave=\"2.5 um\", long_wave=\"0.8 mm\" }"},
        {.name = "write",
         .body = write_surface,
         .sentence = "Writes the heights: .h5 (HDF5, with an .xdmf beside it for ParaView), .npy, .x3p, .gwy "
                     "(Gwyddion), .txt, .asc or .csv by the extension of the path. All read back bit for "
                     "bit, points that were not measured too. .sdf (ISO 25178-71) keeps heights and holes "
                     "bit for bit, and the spacing of points. .sur (Digital Surf) rounds heights to 2^-30 of "
                     "the greatest and the size to single precision.",
         .parameters = {{"path", "string", "under the run directory"}},
         .returns = "string",
         .example = "s:write \"specimen.x3p\"",
         .heavy = true},
        {.name = "picture",
         .body = picture,
         .sentence = "A picture of the heights as PNG, true to scale, with scale and colour bars; points "
                     "that were not measured are left blank.",
         .parameters = {{"path", "string", "a .png under the run directory"}},
         .options = &picture_block(),
         .options_optional = true,
         .returns = "string",
         .example = "s:picture(\"surface.png\", { title=\"D = 2.5\" })",
         .heavy = true},
        {.name = "levelled",
         .body = level,
         .sentence = "Less the least-squares polynomial of a degree, fitted to the measured nodes.",
         .options = &level_block(),
         .options_optional = true,
         .returns = "Surface",
         .example = "s:levelled{ degree=1 }"},
    };
    for (Function& method : missing_point_methods_of_surface()) c.methods.push_back(std::move(method));
    c.methods.push_back(registered_to_method());
    for (Function& operation : surface_operations()) c.methods.push_back(std::move(operation));
    for (Function& parameters : parameter_methods()) c.methods.push_back(std::move(parameters));
    c.results = {&roughness_type(true), &spectrum_type(), &fractal_dimension_type(), &outliers_type(true)};
    for (const RecordInfo* result : parameter_results()) c.results.push_back(result);
    for (const RecordInfo* result : registration_types()) c.results.push_back(result);
    return c;
  }();
  return type;
}

}  // namespace asperity::lua
