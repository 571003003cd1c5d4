// SPDX-License-Identifier: GPL-3.0-or-later
// Unmeasured points: count and mask; masking by mask, function or outlier rule; filling.
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/operations/operations.hpp"

namespace asperity::lua {

namespace {

Value mask_field(const Grid& grid, Field mask) {
  return object(
      NamedField{"measured", grid, std::make_shared<const Field>(std::move(mask)), dimension::number});
}

struct OutlierKeys : OutlierRule {
  enum class Rule { mad } rule = Rule::mad;
};
const Block<OutlierKeys> outliers_block{
    {choice("rule", &OutlierKeys::rule, {{"mad", OutlierKeys::Rule::mad}},
            "\"mad\": a point is an outlier if its height less the median of the measured ones around it "
            "lies farther from the median of all such residuals than factor times 1.4826 times their median "
            "absolute deviation, which of Gaussian residuals is their standard deviation"),
     number("factor", &OutlierRule::factor, above(0), "in standard deviations of Gaussian residuals"),
     integer("window", &OutlierRule::window, between(3, 31),
             "odd number of points a side of the square (of a profile: of the stretch) around a point whose "
             "median is taken")},
    [](OutlierKeys& keys, Problems& problems) {
      if (keys.window % 2 == 0)
        problems.push_back("`window` is " + std::to_string(keys.window) +
                           ", which has no middle: give an odd number, e.g. " +
                           std::to_string(keys.window + 1));
    }};

struct FoundOutliers {
  OutlierRule rule;
  Outliers found;
  Grid grid;
  std::int64_t measured = 0;
};

std::vector<RecordField<FoundOutliers>> outlier_fields(RecordField<FoundOutliers> mask) {
  using F = FoundOutliers;
  return {{"marked", [](const F& f) { return f.found.marked; }, "how many points are outliers by the rule"},
          {"measured", &F::measured, "how many points were measured, outliers among them"},
          {"rule", [](const F&) { return "mad"; }, "by which they were found"},
          {"factor", [](const F& f) { return f.rule.factor; }, "of the rule"},
          {"window", [](const F& f) { return f.rule.window; }, "of the rule, in points"},
          {"deviation", [](const F& f) { return f.found.deviation; }, dimension::length,
           "1.4826 times the median absolute deviation of the residuals"},
          {"limit", [](const F& f) { return f.found.limit; }, dimension::length,
           "how far a residual may lie from their median: factor times deviation"},
          std::move(mask)};
}

constexpr const char* outliers_sentence = "Measured points that a rule takes for outliers; none is removed.";
const RecordType<FoundOutliers> areal_outliers_type{
    "Outliers", "outliers", outliers_sentence,
    outlier_fields({"mask", "Field", [](const FoundOutliers& f) { return mask_field(f.grid, f.found.mask); },
                    "1 where a point was measured and is no outlier, else 0: for s:masked{ mask= }"})};
const RecordType<FoundOutliers> profile_outliers_type{
    "ProfileOutliers", "outliers", outliers_sentence,
    outlier_fields({"mask", "number[]",
                    [](const FoundOutliers& f) { return number_list(f.found.mask.values()); },
                    "1 where a sample was measured and is no outlier, else 0: for p:masked{ mask= }"})};

// A warning: removed outliers stay visible.
void tell_of(const Call& call, const OutlierRule& rule, const Outliers& found, std::size_t measured) {
  if (found.marked == 0) return;
  call.warn(std::to_string(found.marked) + " of " + std::to_string(measured) +
            " measured points are outliers by the rule \"mad\", factor " + format_short(rule.factor) +
            " and window " + std::to_string(rule.window) + " (more than " +
            format_quantity(found.limit, dimension::length, 3) +
            " from the points around them), and count as not measured");
}

struct MaskKeys {
  bool mask = false;
  bool function = false;  // the caller reads it
  std::optional<OutlierKeys> outliers;
  std::shared_ptr<const NamedField> field;
  std::optional<Array<double>> samples;  // mask of a profile
};

using ReadMask = void (*)(const Argument&, const OptionInfo&, MaskKeys&, Problems&);

// A function, or a mask for `read_mask`.
Option<MaskKeys> mask_key(const char* type, const char* sentence, ReadMask read_mask) {
  return custom<MaskKeys>(
      "mask", type, sentence,
      [read_mask](const Argument& value, const OptionInfo& info, MaskKeys& keys, Problems& problems) {
        keys.mask = true;
        keys.function = value.is_function();
        if (!keys.function) read_mask(value, info, keys, problems);
      });
}

Option<MaskKeys> outliers_key() {
  auto option = custom<MaskKeys>(
      "outliers", "\"mad\"|table",
      "outliers by this rule, as s:outliers finds them, count as not measured; their number "
      "is told in a warning: the rule, or a table with its keys",
      [](const Argument& value, const OptionInfo& info, MaskKeys& keys, Problems& problems) {
        if (value.is_text()) {
          if (detail::read_word(value, info, {"mad"}, problems)) keys.outliers = OutlierKeys{};
          return;
        }
        if (!value.is_table())
          return detail::wrong_type(value, info, "\"mad\" or a table of its keys", problems);
        detail::collect(problems, [&] { keys.outliers = outliers_block.read(value, quoted(info.name)); });
      });
  option.info.inner = &outliers_block;
  return std::move(option).shown_by([](const MaskKeys& keys) -> std::string {
    if (!keys.outliers) return "";
    return "{ rule=\"mad\", factor=" + format_exact(keys.outliers->factor) +
           ", window=" + std::to_string(keys.outliers->window) + " }";
  });
}

void one_of_two(MaskKeys& keys, Problems& problems) {
  if (keys.mask == keys.outliers.has_value())
    problems.push_back(std::string("give one of `mask` and `outliers`; ") +
                       (keys.mask ? "both are given" : "none is given"));
}

void read_field_mask(const Argument& value, const OptionInfo& info, MaskKeys& keys, Problems& problems) {
  Object* object = value.as_object(class_of<NamedField>());
  if (object == nullptr)
    return detail::wrong_type(value, info, "a function(x, y, z), or a field such as another surface's mask",
                              problems);
  if (object->pointer != nullptr) keys.field = std::static_pointer_cast<NamedField>(object->pointer);
}

void read_sample_mask(const Argument& value, const OptionInfo& info, MaskKeys& keys, Problems& problems) {
  if (!value.is_table())
    return detail::wrong_type(value, info, "a function(x, z), or a list of a number a sample", problems);
  Array<double> mask;
  value.elements([&](const Argument& item) {
    if (item.is_number()) mask.push_back(item.number());
  });
  if (static_cast<std::int64_t>(mask.size()) != value.length())
    return problems.push_back(quoted(info.name) + " holds other values than numbers");
  keys.samples = std::move(mask);
}

const Block<MaskKeys> mask_surface_block{
    {mask_key("function|Field",
              "the points that count as not measured: function(x, y, z), all in metres, returns true for "
              "them; a field of the same cells, such as another surface's mask, is 0 or nan there",
              read_field_mask),
     outliers_key()},
    one_of_two};

const Block<MaskKeys> mask_profile_block{
    {mask_key("function|number[]",
              "the samples that count as not measured: function(x, z), both in metres, returns true for "
              "them; a list holds 0 or nan there",
              read_sample_mask),
     outliers_key()},
    one_of_two};

Values mask_surface(Call& call) {
  const MaskKeys keys = call.options(mask_surface_block);
  const Surface& s = call.self<Surface>();
  const Grid& grid = s.grid();
  if (keys.field != nullptr) return {object(masked(s, *keys.field->values))};
  if (keys.outliers) {
    const Outliers found = find_outliers(s, *keys.outliers, call.session().monitor());
    tell_of(call, *keys.outliers, found, s.measured());
    return {object(masked(s, found.mask))};
  }
  Field mask = mask_of(s);
  Task task(call.session().monitor(), "points by a function", grid.ny);
  with_key(call.argument(1), "mask", [&](const Argument& function) {
    const Callback is_missing(function);
    for (int j = 0; j < grid.ny; ++j, task.advance())
      for (int i = 0; i < grid.nx; ++i)
        if (mask(i, j) != 0 &&
            is_missing.answer({i * grid.hx(), j * grid.hy(), s.measured_heights()(i, j)}, "mask"))
          mask(i, j) = 0;
  });
  return {object(masked(s, mask))};
}

Values mask_profile(Call& call) {
  const MaskKeys keys = call.options(mask_profile_block);
  const Profile& p = call.self<Profile>();
  if (keys.samples) return {object(masked(p, *keys.samples))};
  if (keys.outliers) {
    const Outliers found = find_outliers(p, *keys.outliers);
    tell_of(call, *keys.outliers, found, p.measured());
    return {object(masked(p, found.mask.values()))};
  }
  Array<double> mask = mask_of(p);
  with_key(call.argument(1), "mask", [&](const Argument& function) {
    const Callback is_missing(function);
    for (std::size_t k = 0; k < mask.size(); ++k)
      if (mask[k] != 0 &&
          is_missing.answer({static_cast<double>(k) * p.spacing(), p.measured_heights()[k]}, "mask"))
        mask[k] = 0;
  });
  return {object(masked(p, mask))};
}

struct FillKeys {
  bool interpolate = false;
  std::optional<double> value;
};
const Block<FillKeys> fill_block{
    {choice("by", &FillKeys::interpolate, {{"interpolate", true}},
            "\"interpolate\": the harmonic continuation of the heights around, which never leaves their "
            "range and is smoother than they are; filled ground lowers slopes"),
     quantity("value", &FillKeys::value, dimension::length, any(), "this height")},
    [](FillKeys& keys, Problems& problems) {
      if (keys.interpolate == keys.value.has_value())
        problems.push_back(keys.value ? "give `by` or `value`, not both"
                                      : "give the missing points a height: `by=\"interpolate\"` or `value=`");
    }};

Function outliers_function(Body body, bool surface) {
  return {
      .name = "outliers",
      .body = body,
      .sentence =
          std::string("Which measured points a rule takes for outliers, and how many; none is removed: ") +
          (surface ? "s" : "p") + ":masked{ outliers= } or mask= does that.",
      .options = optional(outliers_block),
      .returns = surface ? "Outliers" : "ProfileOutliers",
      .example = surface ? "print(s:outliers{ factor=8 }.marked)" : "print(p:outliers{ window=15 }.marked)",
      .heavy = true};
}

}  // namespace

const RecordInfo& outliers_type(bool surface) {
  return surface ? areal_outliers_type : profile_outliers_type;
}

std::string missing_text(std::size_t measured, std::size_t points) {
  if (measured == points) return "";
  return ", " + std::to_string(points - measured) + " of " + std::to_string(points) + " points not measured";
}

std::vector<Getter> missing_point_fields_of_surface() {
  return {
      getter<&Surface::measured>("measured", "integer",
                                 "how many points were measured; all of them where the surface has no holes"),
      getter<Surface>("mask", "Field", "1 where a point was measured, 0 where not",
                      [](const Surface& of) { return mask_field(of.grid(), mask_of(of)); })};
}

std::vector<Getter> missing_point_fields_of_profile() {
  return {getter<&Profile::measured>(
              "measured", "integer",
              "how many samples were measured; all of them where the profile has no holes"),
          getter<Profile>("mask", "number[]", "1 for a sample that was measured, 0 for one that was not",
                          [](const Profile& of) { return mask_of(of); })};
}

std::vector<Function> missing_point_methods_of_surface() {
  return {
      outliers_function(method([](const Surface& s, Call& call) {
                          const OutlierKeys keys = call.options(outliers_block);
                          return areal_outliers_type({keys, find_outliers(s, keys, call.session().monitor()),
                                                      s.grid(), static_cast<std::int64_t>(s.measured())});
                        }),
                        true),
      {.name = "masked",
       .body = mask_surface,
       .sentence = "The surface with more points that count as not measured. Statistics, filters and "
                   "pictures leave them out; who needs every point, as a contact does, refuses them.",
       .options = &mask_surface_block,
       .returns = "Surface",
       .example = "print(s:masked{ mask=function(x, y, z) return z > 2e-6 end }.measured)",
       .heavy = true},
      {.name = "filled",
       .body = method([](const Surface& s, Call& call) {
         return filled(s, call.options(fill_block).value, call.session().monitor());
       }),
       .sentence = "The surface with a height at every point that was not measured.",
       .options = &fill_block,
       .returns = "Surface",
       .example = "s:masked{ outliers=\"mad\" }:filled{ by=\"interpolate\" }",
       .heavy = true}};
}

std::vector<Function> missing_point_methods_of_profile() {
  return {
      outliers_function(method([](const Profile& p, Call& call) {
                          const OutlierKeys keys = call.options(outliers_block);
                          return profile_outliers_type(
                              {keys, find_outliers(p, keys), {}, static_cast<std::int64_t>(p.measured())});
                        }),
                        false),
      {.name = "masked",
       .body = mask_profile,
       .sentence = "The profile with more samples that count as not measured.",
       .options = &mask_profile_block,
       .returns = "Profile",
       .example = "print(p:masked{ outliers={ rule=\"mad\", factor=8, window=15 } }.measured)",
       .heavy = true},
      {.name = "filled",
       .body = method([](const Profile& p, Call& call) {
         return filled(p, call.options(fill_block).value, call.session().monitor());
       }),
       .sentence = "The profile with a height at every sample that was not measured; by=\"interpolate\" is "
                   "the straight line across a gap, and the last height at an end.",
       .options = &fill_block,
       .returns = "Profile",
       .example = "p:masked{ mask=function(x, z) return x > 1e-4 and x < 2e-4 end }:filled{ value=0 }",
       .heavy = true}};
}

}  // namespace asperity::lua
