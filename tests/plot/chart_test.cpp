// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/plot/chart.hpp"

#include <cmath>
#include <limits>

#include "tests/support/run_fixture.hpp"

namespace asperity::chart_test {
namespace {

using ChartTest = InFolder;

LineChart simple() {
  LineChart chart;
  chart.x.label = "pressure";
  chart.x.unit = "Pa";
  chart.y.label = "mu";
  ChartSeries series;
  series.x = {1e6, 2e6, 3e6};
  series.y = {0.3, 0.4, 0.5};
  chart.series.push_back(series);
  return chart;
}

std::string script_of(const LineChart& chart, std::vector<std::string>* warnings = nullptr) {
  std::vector<std::string> ignored;
  return chart_script(chart, PictureFormat::svg, warnings == nullptr ? ignored : *warnings);
}

TEST(Chart, ShowsUnitsWithPrefix) {
  const std::string script = script_of(simple());
  EXPECT_NE(script.find("set xlabel 'pressure (MPa)'"), std::string::npos);
  EXPECT_NE(script.find("set ylabel 'mu'"), std::string::npos);
  EXPECT_NE(script.find("\n1 0.3 0.3 0.3\n2 0.4 0.4 0.4\n3 0.5 0.5 0.5\n"), std::string::npos);
  EXPECT_NE(script.find("set key off"), std::string::npos);
}

TEST(Chart, LinesDifferInColourShapeAndDashes) {
  LineChart chart = simple();
  chart.series.push_back(chart.series[0]);
  chart.series[0].name = "A";
  chart.series[1].name = "B";
  const std::string script = script_of(chart);
  EXPECT_NE(script.find("linecolor rgb '#0072b2' linewidth 2.2 dashtype 1 pointtype 7"), std::string::npos);
  EXPECT_NE(script.find("linecolor rgb '#d55e00' linewidth 2.2 dashtype '-' pointtype 5"), std::string::npos);
  EXPECT_NE(script.find("set key outside"), std::string::npos);
}

TEST(Chart, BarsAlongXAndMarksThatAreNoLines) {
  LineChart chart = simple();
  chart.series[0].x_low = {0.5e6, 2e6, 3e6};
  chart.series[0].x_high = {1.5e6, 2e6, 4e6};
  ChartSeries ring;
  ring.x = {2e6};
  ring.y = {0.4};
  ring.line = false;
  ring.shape = PointShape::ring;
  chart.series.push_back(ring);
  const std::string script = script_of(chart);
  EXPECT_NE(script.find("\n1 0.3 0.3 0.3 0.5 1.5\n2 0.4 0.4 0.4 2 2\n3 0.5 0.5 0.5 3 4\n"),
            std::string::npos);
  EXPECT_NE(script.find("using 1:2:5:6 with xerrorbars"), std::string::npos);
  EXPECT_NE(script.find(
                "$line1 using 1:2 with points linecolor rgb '#505050' linewidth 1.2 pointtype 6 pointsize 2"),
            std::string::npos);
  chart.series[0].x_high.pop_back();
  EXPECT_THROW(script_of(chart), Error);
}

TEST(Chart, SaysWhatIsNotDrawn) {
  LineChart chart = simple();
  chart.series[0].x = {1e6, 0, -1, 2e6, 3e6, std::nan("")};
  chart.series[0].y = {0.1, 0.2, 0.3, 0, std::numeric_limits<double>::infinity(), 1};
  chart.x.logarithmic = chart.y.logarithmic = true;
  std::vector<std::string> warnings;
  script_of(chart, &warnings);
  EXPECT_EQ(warnings,
            (std::vector<std::string>{
                "2 of 6 values are not drawn: not finite",
                "2 of 6 values are not drawn: `pressure` is not above zero, and its axis is logarithmic",
                "1 of 6 values are not drawn: `mu` is not above zero, and its axis is logarithmic"}));
}

// A value beyond the plot's range is not a missing value.
TEST(Chart, SaysThatANumberIsTooLarge) {
  LineChart chart = simple();
  chart.series[0].y[0] = 2e300;
  std::vector<std::string> warnings;
  script_of(chart, &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("too large to draw (above 1e300)"), std::string::npos) << warnings[0];
}

TEST(Chart, RefusesToDrawNothing) {
  LineChart chart = simple();
  chart.series[0].y = {-1, -1, 0};
  chart.y.logarithmic = true;
  EXPECT_EQ(error_of([&] { script_of(chart); }),
            "bad_value: the chart of `mu` against `pressure` has nothing to draw; 3 of 3 values are not "
            "drawn: `mu` is "
            "not above zero, and its axis is logarithmic");
  chart.series.clear();
  EXPECT_NE(error_of([&] { script_of(chart); }), "");
}

TEST(Chart, RefusesLinesOfUnequalLength) {
  LineChart chart = simple();
  chart.series[0].y.pop_back();
  EXPECT_EQ(error_of([&] { script_of(chart); }),
            "bad_value: the line `` of a chart has 3 x and 2 y values; give as many of one as of the other, "
            "and as many "
            "errors or none");
  chart = simple();
  chart.series[0].y_error = {0.1};
  EXPECT_NE(error_of([&] { script_of(chart); }), "");
}

TEST(Chart, ErrorBarsEndAtTheRimOfALogarithmicAxis) {
  LineChart chart = simple();
  chart.y.logarithmic = true;
  chart.series[0].y_error = {0.5, 0.1, std::nan("")};
  const std::string script = script_of(chart);
  EXPECT_NE(script.find("yerrorbars"), std::string::npos);
  EXPECT_EQ(script.find("-0.2"), std::string::npos);
  EXPECT_NE(script.find("\n3 0.5 0.5 0.5\n"), std::string::npos);
  // The first bar reaches below zero: its lower half is an arrow to the frame, without a cap.
  EXPECT_NE(script.find("$open0 << EOD\n1 0.3 -"), std::string::npos);
  EXPECT_NE(script.find("$open0 using 1:2:(0):3 with vectors"), std::string::npos);
  EXPECT_NE(script.find("\n1 0.3 0.3 0.8\n"), std::string::npos);
}

TEST(Chart, InPrintHasItsWidthAndTextOfItsSize) {
  LineChart chart = simple();
  print_at(chart, 0.085, 8);
  EXPECT_EQ(chart.width, 482);
  std::vector<std::string> warnings;
  EXPECT_TRUE(
      chart_script(chart, PictureFormat::pdf, warnings).starts_with("set terminal pdfcairo size 3.3"));
  EXPECT_TRUE(
      chart_script(chart, PictureFormat::png, warnings).starts_with("set terminal pngcairo size 1004,"));
  EXPECT_EQ(printed_at("<svg viewBox", 0.085, 0.06), "<svg width=\"85mm\" height=\"60mm\" viewBox");
  EXPECT_EQ(error_of([&] { print_at(chart, 0.025, 12); }),
            "bad_value: a chart 25 mm wide with text of 12 points has no room for its lines; give a "
            "`font_size` of at most 3");
}

TEST(Chart, LegendHasAChosenPlace) {
  LineChart chart = simple();
  chart.series[0].name = "mean";
  chart.legend = "top left";
  EXPECT_NE(script_of(chart).find("set key inside top left"), std::string::npos);
  chart.legend = "below";
  EXPECT_NE(script_of(chart).find("set key below"), std::string::npos);
  chart.legend = "none";
  EXPECT_NE(script_of(chart).find("set key off"), std::string::npos);
}

TEST(Chart, EqualAxesShareOneUnit) {
  LineChart chart = simple();
  chart.x.unit = chart.y.unit = "m";
  chart.series[0].x = {0, 1e-3};
  chart.series[0].y = {0, 1e-6};
  chart.equal_axes = true;
  const std::string script = script_of(chart);
  EXPECT_NE(script.find("'pressure (mm)'"), std::string::npos);
  EXPECT_NE(script.find("'mu (mm)'"), std::string::npos);
  EXPECT_NE(script.find("set size ratio -1"), std::string::npos);
}

TEST_F(ChartTest, DrawsWithoutAComplaint) {
  LineChart chart = simple();
  chart.title = "a'b`touch x` <b>&c";
  chart.key_title = "D";
  chart.series[0].name = "2 \"quoted\"";
  chart.series[0].y_error = {0.01, 0.02, 0.03};
  chart.series[0].cloud_x = {1e6, 1e6};
  chart.series[0].cloud_y = {0.29, 0.31};
  for (const bool logarithmic : {false, true}) {
    chart.x.logarithmic = chart.y.logarithmic = logarithmic;
    for (const PictureFormat format : {PictureFormat::svg, PictureFormat::png}) {
      std::vector<std::string> warnings;
      EXPECT_EQ(run_gnuplot(chart_script(chart, format, warnings)).messages, "");
      EXPECT_TRUE(warnings.empty());
    }
  }
  EXPECT_TRUE(draw(chart, folder / "a.svg").empty());
  const std::string svg = content_of(folder / "a.svg");
  EXPECT_TRUE(svg.find("</svg>") != std::string::npos) << svg.substr(svg.size() - 40);
  EXPECT_NE(svg.find("a’b`touch x` &lt;b>&amp;c"), std::string::npos);
  draw(chart, folder / "a.png");
  EXPECT_TRUE(content_of(folder / "a.png").starts_with("\x89PNG"));
  EXPECT_EQ(files_in(folder), 2U);
}

TEST_F(ChartTest, DrawsExtremesWithoutAComplaint) {
  for (const double scale : {1e-300, 1e-12, 1.0, 1e12, 1e300})
    for (const bool logarithmic : {false, true}) {
      LineChart chart = simple();
      chart.x.unit = "";
      chart.series[0].x = {0.1 * scale, 0.5 * scale, scale};
      chart.series[0].y = {scale, scale, scale};
      chart.x.logarithmic = chart.y.logarithmic = logarithmic;
      std::vector<std::string> warnings;
      EXPECT_EQ(run_gnuplot(chart_script(chart, PictureFormat::png, warnings)).messages, "")
          << scale << logarithmic;
      EXPECT_TRUE(warnings.empty());
    }
}

TEST(Chart, BandStandsBehindItsLine) {
  LineChart chart = simple();
  ChartSeries fit = chart.series[0];
  fit.name = "fit";
  fit.points = false;
  fit.y_low = {0.2, 0.3, 0.4};
  fit.y_high = {0.4, 0.5, 0.9};
  fit.band = true;
  chart.series.push_back(fit);
  const std::string script = script_of(chart);
  EXPECT_NE(script.find("\n1 0.3 0.2 0.4\n2 0.4 0.3 0.5\n3 0.5 0.4 0.9\n"), std::string::npos);
  const std::size_t band = script.find("$line1 using 1:3:4 with filledcurves"),
                    line = script.find("$line0 using 1:2 with linespoints");
  EXPECT_LT(band, line);
  EXPECT_NE(script.find("$line1 using 1:2 with lines linecolor rgb '#d55e00'"), std::string::npos);
  EXPECT_EQ(script.find("yerrorbars"), std::string::npos);
  EXPECT_NE(script.find("set yrange [0.17"), std::string::npos);  // includes the band with a margin
  chart.series[1].y_low.pop_back();
  EXPECT_THROW(script_of(chart), Error);
}

TEST(Chart, UnequalEndsAreErrorBars) {
  LineChart chart = simple();
  chart.series[0].y_low = {0.1, 0.2, std::nan("")};
  chart.series[0].y_high = {0.35, 0.5, 1};
  const std::string script = script_of(chart);
  EXPECT_NE(script.find("\n1 0.3 0.1 0.35\n2 0.4 0.2 0.5\n3 0.5 0.5 0.5\n"), std::string::npos);
  EXPECT_NE(script.find("using 1:2:3:4 with yerrorbars"), std::string::npos);
}

TEST_F(ChartTest, LongNamesStandBelowThePlotAndLeaveItItsWidth) {
  LineChart chart = simple();
  chart.series[0].name = "one face, for itself";
  EXPECT_NE(script_of(chart).find("set key outside right"), std::string::npos);
  chart.series.push_back(chart.series[0]);
  chart.series[1].name = "one face, for its kind (band: 68 % of faces)";
  EXPECT_NE(script_of(chart).find("set key below left"), std::string::npos);
  chart.width *= 2;
  EXPECT_NE(script_of(chart).find("set key outside right"), std::string::npos);
  chart.width /= 2;
  std::vector<std::string> warnings;
  EXPECT_EQ(run_gnuplot(chart_script(chart, PictureFormat::svg, warnings)).messages, "");
  EXPECT_TRUE(warnings.empty());
}

TEST(Chart, LinesAcrossReachFromRimToRimAndAreNamedInTheKey) {
  LineChart chart = simple();
  chart.references = {{{}, 0.9, "measured"}, {2.5e6, {}, ""}};
  std::vector<std::string> warnings;
  const std::string script = script_of(chart, &warnings);
  EXPECT_NE(script.find("$across0 << EOD\n0.92 0.9\n3.08 0.9\nEOD"), std::string::npos);
  EXPECT_NE(script.find("title 'measured'"), std::string::npos);
  EXPECT_NE(script.find("$across1 << EOD\n2.5 "), std::string::npos);
  EXPECT_NE(script.find("set key outside"), std::string::npos);
  EXPECT_TRUE(warnings.empty());
  chart.y.logarithmic = true;
  chart.references[0].y = 0;
  script_of(chart, &warnings);
  EXPECT_EQ(warnings,
            (std::vector<std::string>{"the line at y = 0 is not drawn: it has no place on its axis"}));
}

TEST(Chart, BarsOfAHistogramStandOnTheAxis) {
  LineChart chart;
  chart.x.label = "angle";
  chart.y.label = "number";
  chart.bars = {{0, 2, 3}, {2, 4, 5}};
  const std::string script = script_of(chart);
  EXPECT_NE(script.find("$bars << EOD\n1 0 0 2 0 3\n3 0 2 4 0 5\nEOD"), std::string::npos);
  EXPECT_NE(script.find("set yrange [0:"), std::string::npos);
}

TEST(Chart, PanelsStandBelowEachOtherOverOneRange) {
  LineChart above = simple(), below = simple();
  below.series[0].x = {2e6, 4e6, 6e6};
  below.y.label = "Ra";
  below.series[0].name = "a longer name";
  std::vector<std::string> warnings;
  const std::string script = chart_script(std::vector<LineChart>{above, below}, PictureFormat::svg, warnings);
  EXPECT_NE(script.find("size 960,960"), std::string::npos);
  EXPECT_NE(script.find("set multiplot layout 2,1"), std::string::npos);
  const std::size_t first = script.find("set xrange [0.8:6.2]");
  EXPECT_NE(first, std::string::npos);
  EXPECT_NE(script.find("set xrange [0.8:6.2]", first + 1), std::string::npos);
  EXPECT_NE(script.find("$panel1line0"), std::string::npos);
  EXPECT_NE(script.find("set lmargin at screen 0.13\n"), std::string::npos);
  // Longer labels need more room.
  above.series[0].y = {0.003, 0.004, 0.005};
  EXPECT_EQ(chart_script(std::vector<LineChart>{above, below}, PictureFormat::svg, warnings)
                .find("set lmargin at screen 0.13\n"),
            std::string::npos);
  below.x.label = "force";
  EXPECT_EQ(
      chart_script(std::vector<LineChart>{above, below}, PictureFormat::svg, warnings).find("[0.8:6.2]"),
      std::string::npos);
}

TEST_F(ChartTest, EveryKindIsDrawnByGnuplotWithoutAWord) {
  LineChart chart = simple(), named = simple();
  chart.references = {{{}, 0.9, "measured"}};
  chart.series.push_back(chart.series[0]);
  chart.series[1].band = true;
  chart.series[1].y_low = chart.series[1].y_high = {0.2, 0.3, 0.4};
  named.x.names = {"a body of a long name", "another body of it", "short"};
  named.series[0].x = {0, 1, 2};
  named.bars = {{-0.2, 0.2, 0.1}};
  std::vector<std::string> warnings;
  for (const PictureFormat format : {PictureFormat::svg, PictureFormat::png, PictureFormat::pdf}) {
    const std::string script = chart_script(std::vector<LineChart>{named, chart}, format, warnings);
    const GnuplotResult drawn = run_gnuplot(script);
    EXPECT_EQ(drawn.messages, "");
    EXPECT_EQ(drawn.picture, run_gnuplot(script).picture);
  }
}

}  // namespace
}  // namespace asperity::chart_test
