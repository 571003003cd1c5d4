// SPDX-License-Identifier: GPL-3.0-or-later
// Fields, and methods that measure and write; surface_operations.cpp has the others.
#include <algorithm>

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/surface/known_body.hpp"
#include "bindings/lua/surface/measure.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/metrology/levelling.hpp"
#include "engine/surface/io/hdf5_surface.hpp"
#include "engine/surface/io/write.hpp"

namespace asperity::lua {

namespace {

Values heights(Call& call) {
  const Surface surface = call.self<Surface>();
  // The pointer to the field shares ownership of the surface.
  auto holder = std::make_shared<const Surface>(surface);
  return {Value::Rows(holder, &holder->measured_heights())};
}

Values filtered(Call& call) {
  const GaussianFilter filter = call.options(filter_block);
  const Surface& surface = call.self<Surface>();
  const Grid& grid = surface.grid();
  Values result = {object(gaussian_filtered(surface, filter))};
  warn_of_empty_filter(call, filter, std::max(grid.size_x, grid.size_y), std::min(grid.hx(), grid.hy()));
  return result;
}
Values write_surface(Call& call) {
  const std::string name = call.text(1, "path");
  const std::string path = writable_path(call, name);
  if (has_xdmf_beside(path)) writable_path(call, xdmf_path(name).string());
  write_surface(call.self<Surface>(), path, call.session().monitor());
  return {path};
}

Values picture(Call& call) {
  const PictureOptions options = call.options(picture_block, 2);
  const std::string path = writable_path(call, call.text(1, "path"));
  warn_of(call, draw(call.self<Surface>(), options, path));
  return {path};
}

std::string describe_surface(const Surface& s) {
  const Grid& g = s.grid();
  std::string text = "surface " + std::to_string(g.nx) + " x " + std::to_string(g.ny) + " cells, " +
                     format_quantity(g.size_x, dimension::length) + " x " +
                     format_quantity(g.size_y, dimension::length) + ", peak to valley " +
                     format_quantity(s.peak_to_valley(), dimension::length);
  text += missing_text(s.measured(), g.nodes());
  if (s.material()) text += ", " + s.material()->name;
  return text;
}

}  // namespace

// data table
Class make_class(For<Surface>) {
  Class c{"Surface", "a surface",
          "Heights on a regular grid of cells; an immutable value whose methods return new ones."};
  c.describe = text_of<describe_surface>;
  c.native_bytes = from_value([](const Surface& s) { return s.measured_heights().size() * sizeof(double); });
  c.equal = have_one_digest<Surface>;
  c.digest = text_of<&Surface::digest>;
  c.known = known_result;
  c.fields = {
      getter<Surface>("cells", "{nx, ny}", "cells along x and y",
                      [](const Surface& of) { return along_axes(of.grid().nx, of.grid().ny); }),
      getter<Surface>(
          "size", "{number, number}", "length along x and y",
          [](const Surface& of) { return along_axes(of.grid().size_x, of.grid().size_y); },
          dimension::length),
      getter<&Surface::material>("material", "Material", "material of the body, or nil"),
      getter<&Surface::traits, &SurfaceTraits::periodic>(
          "periodic", "boolean", "whether the heights continue smoothly across the rim"),
      getter<&Surface::traits, &SurfaceTraits::aliased_share>(
          "aliased_share", "number", "share of the variance past Nyquist; nil where it is not known"),
      getter<&Surface::peak_to_valley>("peak_to_valley", "number", "greatest less least height",
                                       dimension::length),
      getter<&Surface::digest>("digest", "string",
                               "of grid, heights and holes: equal surfaces have equal digests"),
  };
  append(c.fields, missing_point_fields_of_surface());
  c.operators = surface_operators();
  c.methods = {
      {.name = "height",
       .body = method(
           [](const Surface& s, Call& call) { return s.height(call.number(1, "i"), call.number(2, "j")); }),
       .sentence = "Height of node (i, j) in metres, counted from 0; nan where it was not measured.",
       .parameters = {{"i", "integer", "along x"}, {"j", "integer", "along y"}},
       .returns = "number",
       .example = "s:height(0, 0)"},
      {.name = "heights",
       .body = heights,
       .sentence = "All heights as a table of rows, heights[j+1][i+1]; nan at points that were not measured.",
       .returns = "number[][]",
       .example = "local h = s:heights()"},
      {.name = "roughness",
       .body = method([](const Surface& s) { return areal_roughness_type(roughness(s)); }),
       .sentence = "Amplitude and slope statistics over all measured nodes (ISO 25178-2), nothing levelled "
                   "or filtered first. Its amplitude is peak to valley, that of lab.surface.sine half as "
                   "large.",
       .returns = "ArealRoughness",
       .example = "print(s:roughness().Ra)"},
      {.name = "spectrum",
       .body = method([](const Surface& s, Call& call) {
         return spectrum_type({spectrum(s, call.options(spectrum_block)), true});
       }),
       .sentence = "Radially averaged power spectral density; points that were not measured are set to the "
                   "mean, which takes from its power and adds rims.",
       .options = optional(spectrum_block),
       .returns = "Spectrum",
       .example = "local c = s:spectrum().C"},
      {.name = "fractal_dimension",
       .body = method([](const Surface& s, Call& call) {
         return fractal_dimension_type(fractal_dimension(s, call.options(areal_fractal_dimension_block)));
       }),
       .sentence = "Fractal dimension of the profiles of the surface, with its scatter over them.",
       .options = optional(areal_fractal_dimension_block),
       .returns = "FractalDimension",
       .example = "print(s:fractal_dimension{ method=\"structure\" }.D)"},
      {.name = "filtered",
       .body = filtered,
       .sentence = "ISO 16610 Gaussian filter; points that were not measured have no weight and stay so.",
       .options = &filter_block,
       .returns = "Surface",
       .example = "s:filtered{ short_wave=\"2.5 um\", long_wave=\"0.8 mm\" }"},
      {.name = "write",
       .body = write_surface,
       .sentence = "Writes the heights: .h5 (HDF5, with an .xdmf for ParaView), .npy, .x3p, .gwy "
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
       .sentence = "A picture of the heights as PNG, true to scale, with scale and colour bars; points that "
                   "were not measured are left blank.",
       .parameters = {{"path", "string", "a .png under the run directory"}},
       .options = optional(picture_block),
       .returns = "string",
       .example = "s:picture(\"surface.png\", { title=\"D = 2.5\" })",
       .heavy = true},
      {.name = "levelled",
       .body =
           method([](const Surface& s, Call& call) { return levelled(s, call.options(level_block).degree); }),
       .sentence = "Less the least-squares polynomial of a degree, fitted to the measured nodes.",
       .options = optional(level_block),
       .returns = "Surface",
       .example = "s:levelled{ degree=1 }"},
  };
  append(c.methods, missing_point_methods_of_surface(), registered_to_method(), surface_operations(),
         parameter_methods());
  c.results = {&areal_roughness_type, &spectrum_type, &fractal_dimension_type, &outliers_type(true)};
  append(c.results, parameter_results(), registration_types());
  return c;
}

}  // namespace asperity::lua
