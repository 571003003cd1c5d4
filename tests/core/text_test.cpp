// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as text, and the nearest legal name.
#include "engine/core/text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "engine/core/arithmetic/random.hpp"

namespace asperity::text_test {
namespace {

TEST(Text, ExactNumbersReadBack) {
  EXPECT_EQ(format_exact(0.1), "0.1");
  EXPECT_EQ(format_exact(1e-6), "1e-06");
  EXPECT_EQ(format_exact(-0.0), "-0");
  EXPECT_EQ(format_exact(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(format_exact(-std::numeric_limits<double>::infinity()), "-inf");
  EXPECT_EQ(format_exact(std::nan("")), "nan");
  const Stream stream(1, "text");
  for (int k = 0; k < 1000; ++k) {
    const double value =
        std::ldexp(stream.uniform(2 * k) - 0.5, static_cast<int>(stream.below(2 * k + 1, 2000)) - 1000);
    EXPECT_EQ(std::strtod(format_exact(value).c_str(), nullptr), value);
  }
  for (const double value : {std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max()})
    EXPECT_EQ(std::strtod(format_exact(value).c_str(), nullptr), value);
}

TEST(Text, ShortNumbers) {
  EXPECT_EQ(format_short(0.0412), "0.0412");
  EXPECT_EQ(format_short(1234567890.0), "1.23457e+09");
  EXPECT_EQ(format_short(1234567890.0, 3), "1.23e+09");
  EXPECT_EQ(format_short(2.0), "2");
  EXPECT_EQ(format_short(1.0 / 3, 3), "0.333");
  EXPECT_EQ(format_short(std::nan("")), "nan");
  EXPECT_EQ(format_short(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(Text, QuotedAndJoined) {
  EXPECT_EQ(quoted("D"), "`D`");
  const std::vector<std::string> names = {"a", "b", "c"};
  EXPECT_EQ(joined(names), "a, b or c");
  EXPECT_EQ(joined(std::span(names).first(2), " and "), "a and b");
  EXPECT_EQ(joined(std::span(names).first(1)), "a");
  EXPECT_EQ(joined(std::span(names).first(0)), "");
}

const std::vector<std::string> keys = {"cells",     "size",       "hurst", "rms_height",
                                       "rms_slope", "short_wave", "D"};

TEST(Text, NearestNameOfASlip) {
  EXPECT_EQ(nearest_name("cels", keys), "cells");    // a letter dropped
  EXPECT_EQ(nearest_name("celsl", keys), "cells");   // two exchanged
  EXPECT_EQ(nearest_name("Hurst", keys), "hurst");   // case
  EXPECT_EQ(nearest_name("hurrst", keys), "hurst");  // a letter doubled
  EXPECT_EQ(nearest_name("short", keys), "short_wave");
  EXPECT_EQ(nearest_name("rms_hieght", keys), "rms_height");
  EXPECT_EQ(nearest_name("d", keys), "D");
}

TEST(Text, NoNearestNameForSomethingElse) {
  EXPECT_EQ(nearest_name("", keys), "");
  EXPECT_EQ(nearest_name("poisson", keys), "");
  EXPECT_EQ(nearest_name("xy", keys), "");
  EXPECT_EQ(nearest_name(std::string(100000, 'c'), keys), "");
  EXPECT_EQ(nearest_name("cells", std::vector<std::string>{}), "");
  EXPECT_EQ(nearest_name("cells", std::vector<std::string>{std::string(100000, 'c')}), "");
}

TEST(Text, DidYouMean) {
  EXPECT_EQ(did_you_mean("hrust", keys), " (did you mean `hurst`?)");
  EXPECT_EQ(did_you_mean("poisson", keys), "");
}

TEST(Text, PlainTextKeepsWholeCharactersOnly) {
  for (const std::string text :
       {"", "a\tb\n", "250 \xC2\xB5m", "\xE2\x81\xBB\xC2\xB2", "\xF0\x9F\x98\x80", "\xC2\xA0"})
    EXPECT_EQ(plain_text(text), text);
  EXPECT_EQ(plain_text(std::string("a\0b\x1b\x7f\r", 6)), "a?b???");
  EXPECT_EQ(plain_text("\xC2\x9B"), "??");                   // a control character in two bytes
  EXPECT_EQ(plain_text("\xC0\xAF \xE0\x80\xAF"), "?? ???");  // overlong
  EXPECT_EQ(plain_text("\xED\xA0\x80 \xF4\x90\x80\x80 \xFF"), "??? ???? ?");
  EXPECT_EQ(plain_text("um \xC2"), "um ?");  // truncated
  EXPECT_EQ(plain_text("\xE2\x82z"), "??z");
}

TEST(UnfinishedBytes, AreThoseOfACharacterThatIsNotWhole) {
  EXPECT_EQ(unfinished_bytes(""), 0U);
  EXPECT_EQ(unfinished_bytes("a"), 0U);
  EXPECT_EQ(unfinished_bytes("µ"), 0U);
  EXPECT_EQ(unfinished_bytes("a\xC2"), 1U);
  EXPECT_EQ(unfinished_bytes("\xE2\x88"), 2U);
  EXPECT_EQ(unfinished_bytes("\xF0\x9D\x94"), 3U);
  EXPECT_EQ(unfinished_bytes("\x88\x88\x88\x88"), 0U);  // no beginning within three bytes
}

TEST(WithoutTraceback, IsTheMessageAlone) {
  EXPECT_EQ(without_traceback("a.lua:1: no\nstack traceback:\n\t[C]: in ?"), "a.lua:1: no");
  EXPECT_EQ(without_traceback("no"), "no");
}

TEST(SafeFileName, KeepsWhatIsHarmless) {
  EXPECT_EQ(safe_file_name("rotation-memory_2.5"), "rotation-memory_2.5");
  EXPECT_EQ(safe_file_name("Rauheit (µm)"), "Rauheit-µm");
  EXPECT_EQ(safe_file_name("a'b`rm -rf /`"), "a-b-rm-rf");
  EXPECT_EQ(safe_file_name("../../etc/passwd"), "etc-passwd");
  EXPECT_EQ(safe_file_name(".hidden"), "hidden");
  EXPECT_EQ(safe_file_name(""), "unnamed");
  EXPECT_EQ(safe_file_name("///"), "unnamed");
}

TEST(SafeFileName, CutsLongNamesBetweenCharacters) {
  EXPECT_EQ(safe_file_name(std::string(500, 'x')).size(), 120U);
  std::string wide = "x";
  for (int k = 0; k < 100; ++k) wide += "µ";
  const std::string cut = safe_file_name(wide);
  EXPECT_EQ(cut, wide.substr(0, 119));
}

}  // namespace
}  // namespace asperity::text_test
