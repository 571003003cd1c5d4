// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/plot/gnuplot.hpp"

#include <cstdlib>

#include "engine/core/monitor.hpp"
#include "tests/support/run_fixture.hpp"

namespace asperity::gnuplot_test {
namespace {

TEST(GnuplotText, IsALiteralOfExactlyThisText) {
  EXPECT_EQ(gnuplot_text("Ra (µm)"), "'Ra (µm)'");
  EXPECT_EQ(gnuplot_text("a'b`rm -rf`"), "'a’b`rm -rf`'");
  EXPECT_EQ(gnuplot_text("a\nb\tc\x7f"), "'a b c '");
  EXPECT_EQ(gnuplot_text(std::string("\xff\xc3", 2)),
            "'?"
            "?'");
  EXPECT_EQ(gnuplot_text(""), "''");
}

TEST(GnuplotText, IsCutBetweenCharacters) {
  std::string text;
  for (int k = 0; k < 200; ++k) text += "µ";
  EXPECT_EQ(gnuplot_text(text), "'" + text + "'");
  EXPECT_EQ(gnuplot_text(text + "x"), "'" + text + "…'");
}

TEST(GnuplotColour, IsSixDigits) { EXPECT_EQ(gnuplot_colour(0x0072b2), "rgb '#0072b2'"); }

TEST(PictureFormat, FollowsTheEnding) {
  EXPECT_EQ(picture_format("a/b.svg"), PictureFormat::svg);
  EXPECT_EQ(picture_format("b.png"), PictureFormat::png);
  EXPECT_EQ(picture_format("b.pdf"), PictureFormat::pdf);
  EXPECT_EQ(error_of([] { picture_format("b.gif"); }),
            "bad_value: the picture `b.gif` ends in .gif; pictures are .svg, .png or .pdf");
  EXPECT_EQ(error_of([] { picture_format("chart"); }),
            "bad_value: the picture `chart` has no ending; pictures are .svg, .png or .pdf");
}

TEST(WithoutDate, FixesTheDateOfAPdfAndNothingElse) {
  const std::string pdf = "%PDF-1.5\nBT (D:20261123233829Z) ET\n/CreationDate (D:20261123233829Z)\n>>";
  EXPECT_EQ(without_date(pdf), "%PDF-1.5\nBT (D:20261123233829Z) ET\n/CreationDate (D:20000101000000Z)\n>>");
  EXPECT_EQ(without_date(without_date(pdf)), without_date(pdf));
  const std::string svg = "<svg>/CreationDate (D:20261123233829Z)</svg>";
  EXPECT_EQ(without_date(svg), svg);
  EXPECT_EQ(without_date("%PDF-1.5 /CreationDate (D:2026"), "%PDF-1.5 /CreationDate (D:2000");
}

class Gnuplot : public InFolder {
 protected:
  static std::string script(PictureFormat format, std::string_view rest) {
    return gnuplot_terminal(format, 300, 200, 12) + std::string(rest);
  }
};

TEST_F(Gnuplot, DrawsTheSameBytesTwice) {
  for (const PictureFormat format : {PictureFormat::svg, PictureFormat::png, PictureFormat::pdf}) {
    const std::string text = script(format, "$d << EOD\n1 2\n2 3\nEOD\nplot $d with lines title 'x'\n");
    const GnuplotResult once = run_gnuplot(text), twice = run_gnuplot(text);
    EXPECT_EQ(once.messages, "");
    EXPECT_GT(once.picture.size(), 500U);
    EXPECT_EQ(once.picture, twice.picture);
  }
  EXPECT_TRUE(run_gnuplot(script(PictureFormat::png, "plot 1\n")).picture.starts_with("\x89PNG"));
}

TEST_F(Gnuplot, PdfBearsNoDateOfItsMaking) {
  const std::string picture = run_gnuplot(script(PictureFormat::pdf, "plot x\n")).picture;
  EXPECT_TRUE(picture.starts_with("%PDF-"));
  EXPECT_NE(picture.find("/CreationDate (D:20000101000000Z)"), std::string::npos);
}

TEST_F(Gnuplot, RunsNothingThatStandsInText) {
  const std::string mark = (folder / "mark").string();
  const std::string trap = "a'b`touch " + mark + "`\n!touch " + mark + "\nsystem('touch " + mark + "') \\";
  const std::string text = gnuplot_text(trap);
  for (const PictureFormat format : {PictureFormat::svg, PictureFormat::png})
    run_gnuplot(script(format, "set title " + text + "\nset xlabel " + text + "\nset xtics (" + text +
                                   " 0)\nplot x title " + text + "\n"));
  EXPECT_FALSE(std::filesystem::exists(mark));
}

// gnuplot drew without fonts when handles were scarce, and only complained on stderr.
TEST_F(Gnuplot, WhatItSaysThoughItDrawsIsAWarningThatNamesThePicture) {
  const GnuplotResult odd = run_gnuplot(script(PictureFormat::png, "print \"no\\nfont\"\nplot x\n"));
  EXPECT_TRUE(odd.picture.starts_with("\x89PNG"));
  EXPECT_EQ(complaints_of(odd, folder / "r.png"),
            std::vector<std::string>{"`r.png` may look wrong; gnuplot reports: no font"});
  EXPECT_TRUE(complaints_of(run_gnuplot(script(PictureFormat::png, "plot x\n")), "r.png").empty());
}

TEST_F(Gnuplot, ReadsAttachedData) {
  const GnuplotData data{"cells", "1 1\n2 4\n"};
  EXPECT_EQ(run_gnuplot(script(PictureFormat::png, "plot 'cells' with lines\n"), {&data, 1}).messages, "");
}

TEST_F(Gnuplot, PassesOnWhatItComplainsAbout) {
  const std::string text = error_of([] { run_gnuplot(script(PictureFormat::png, "plot nonsense(x)\n")); });
  EXPECT_TRUE(text.starts_with("internal: gnuplot drew no picture: ")) << text;
  EXPECT_NE(text.find("undefined function: nonsense"), std::string::npos) << text;
}

TEST_F(Gnuplot, NamesThePackageWhenMissing) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder.c_str(), 1);
  const std::string text = error_of([] { run_gnuplot(script(PictureFormat::png, "plot x\n")); });
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(
      text,
      "bad_state: charts and pictures are drawn by gnuplot, which is not installed; install the package "
      "gnuplot-nox");
}

TEST_F(Gnuplot, LeavesNothingInTheTemporaryFolder) {
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before == nullptr ? "" : before;
  ::setenv("TMPDIR", folder.c_str(), 1);
  run_gnuplot(script(PictureFormat::png, "plot x\n"));
  EXPECT_EQ(files_in(folder), 0U);
  EXPECT_NE(error_of([] { run_gnuplot(script(PictureFormat::png, "plot nonsense(x)\n")); }), "");
  EXPECT_EQ(files_in(folder), 0U);
  if (before == nullptr) {
    ::unsetenv("TMPDIR");
  } else {
    ::setenv("TMPDIR", kept.c_str(), 1);
  }
}

TEST_F(Gnuplot, StopsWithTheRun) {
  stop_flag().raise(StopReason::interrupt);
  const std::string text = error_of([] { run_gnuplot(script(PictureFormat::png, "pause 60\nplot x\n")); });
  stop_flag().clear();
  EXPECT_EQ(text, "interrupted: interrupted");
}

}  // namespace
}  // namespace asperity::gnuplot_test
