// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/surface/picture.hpp"

namespace asperity::lua {

const Block<PictureOptions>& picture_block() {
  using O = PictureOptions;
  static const Block<O> block{
      "picture",
      {text("title", &O::title, "above the picture"), text("label", &O::label, "of the colour bar"),
       text("palette", &O::palette, "of colours: viridis, cividis, grey, heat, balance or contact"),
       custom<O>("range", "{number, number}", "lowest and highest value of the colours, in SI",
                 [](const Argument& value, const OptionInfo& info, O& o, Problems& problems) {
                   if (!value.is_table() || value.length() != 2)
                     return detail::wrong_type(value, info, "{lowest, highest}", problems);
                   OptionInfo bound = info;
                   bound.dimension = o.unit == "m" ? dimension::length : dimension::number;
                   Range range;
                   for (int k = 1; k <= 2; ++k)
                     value.element(k, [&](const Argument& part) {
                       if (auto v = detail::read_quantity(part, bound, any(), problems))
                         (k == 1 ? range.min : range.max) = *v;
                     });
                   o.range = range;
                 }),
       integer("width", &O::width, between(200, 4000), "of the picture in pixels"),
       choice("view", &O::view, {{"map", O::View::map}, {"relief", O::View::relief}},
              "from above, or in relief")}};
  return block;
}

}  // namespace asperity::lua
