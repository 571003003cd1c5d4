// SPDX-License-Identifier: GPL-3.0-or-later
// Rows become events, errors name line and column, written protocols read back equal.
#include "engine/recording/press_log.hpp"
#include "engine/core/files/source_file.hpp"

#include <cmath>
#include <vector>

#include "tests/support/run_fixture.hpp"
#include "tests/support/warnings.hpp"

namespace asperity::press_log_test {
namespace {

class PressLog : public InFolder {
 protected:
  Protocol read(const std::string& content) {
    write_log(content);
    return read_press_log(SourceFile(path(), listener), listener);
  }
  std::string events(const std::string& content) {
    std::string lines;
    const Protocol protocol = read(content);
    for (const Protocol::Event& event : protocol.events()) lines += text(event.step) + "\n";
    return lines;
  }
  // The error without the file name.
  std::string refusal(const std::string& content) {
    write_log(content);
    std::string error = error_of([&] { read_press_log(SourceFile(path(), listener), listener); });
    const std::string name = "\"" + path() + "\" ";
    if (const std::size_t at = error.find(name); at != std::string::npos) error.erase(at, name.size());
    return error;
  }
  std::string path() const { return (folder / "log.csv").string(); }
  void write_log(const std::string& content) const {
    std::ofstream(folder / "log.csv", std::ios::binary) << content;
  }
  test::Warnings listener;
};

using PressLogWriter = PressLog;

TEST_F(PressLog, RowsAreEvents) {
  const Protocol p = read(
      "time [s], pressure [MPa], rotation [deg], dwell [min]\n"
      "0, 152.78, 0, 10\n"
      "900, 152.78, 90, 10\n"
      "1800, 0, 0, 0\n");
  EXPECT_EQ(p.text(),
            "protocol of 5 events\n"
            "  1  press 152.78 MPa for 10 min (at 0 s, log.csv line 2)\n"
            "  2  release (at 900 s, log.csv line 3)\n"
            "  3  rotate 90 deg (at 900 s, log.csv line 3)\n"
            "  4  press 152.78 MPa for 10 min (at 900 s, log.csv line 3)\n"
            "  5  release (at 1800 s, log.csv line 4)");
  EXPECT_EQ(std::get<PressRequest>(p.events()[0].step).value, 152.78e6);
  EXPECT_EQ(std::get<PressRequest>(p.events()[0].step).dwell, 600.0);
  EXPECT_EQ(p.events()[3].origin, "log.csv line 3");
  EXPECT_TRUE(listener.all.empty());
}

TEST_F(PressLog, ColumnsStandInAnyOrderAndAreNamedFreely) {
  EXPECT_EQ(events("DWELL (s),Seed, Load(kN) ,Turn [ rad ]\n1,7,0.25,-1.5\n"),
            "place with seed 7\nrotate -85.9437 deg\npress 250 N for 1 s\n");
}

TEST_F(PressLog, APressureAloneIsEnough) { EXPECT_EQ(events("pressure [GPa]\n0.5\n"), "press 500 MPa\n"); }

TEST_F(PressLog, SemicolonsAndTabsAllowDecimalCommas) {
  const std::string expected = "press 1.5 MPa for 2.5 s\n";
  EXPECT_EQ(events("pressure [MPa];dwell [s]\n1,5;2,5\n"), expected);
  EXPECT_EQ(events("pressure [MPa]\tdwell [s]\n1,5\t2,5\n"), expected);
  EXPECT_EQ(events("pressure [MPa];dwell [s]\n1.5;+2.5\n"), expected);
  EXPECT_EQ(events("sep=;\npressure [MPa];dwell [s]\n1,5;2,5\n"), expected);
}

TEST_F(PressLog, WhatSpreadsheetsAddIsReadOver) {
  EXPECT_EQ(events("\xEF\xBB\xBF# kept by hand\r\n\r\n\"Pressure [MPa]\",\"Dwell [s]\",\r\n"
                   "\"1.5\",2.5,\r\n,,\r\n# a note\r\n\r\n2,,\r\n"),
            "press 1.5 MPa for 2.5 s\npress 2 MPa\n");
}

TEST_F(PressLog, QuotedCellsGoOnOverLinesWhichAreCounted) {
  const std::string log =
      "\"time\n[s]\",\"pressure\n[MPa]\",note\n0,10,\"pressed\nat noon\"\n60,0,\"x\"\n120,20,y\n";
  EXPECT_EQ(read(log).text(),
            "protocol of 3 events\n"
            "  1  press 10 MPa (at 0 s, log.csv line 4)\n"
            "  2  release (at 60 s, log.csv line 6)\n"
            "  3  press 20 MPa (at 120 s, log.csv line 7)");
  EXPECT_NE(refusal("time [s],load [kN],note\n0,1,\"a\nb\"\n10,2,\"x\n\"\n20,fast,z\n")
                .find("line 6, column 2 (load): \"fast\" is no number"),
            std::string::npos);
  EXPECT_NE(refusal("time [s];load [kN];note\n0;1;\"a\nb\n10;2;x\n")
                .find("has a quote in line 2 that is never closed"),
            std::string::npos);
}

TEST_F(PressLog, DegreesAsSpreadsheetsWriteThem) {
  for (const char* unit : {"deg", "\xC2\xB0", "\xB0"})
    EXPECT_EQ(events("pressure [MPa],rotation [" + std::string(unit) + "]\n1,90\n"),
              "rotate 90 deg\npress 1 MPa\n");
}

TEST_F(PressLog, CommentsEndARowAndNotesMayHoldTheirMark) {
  EXPECT_EQ(events("pressure [MPa],dwell [s]\n1,2 # first, by hand\n"), "press 1 MPa for 2 s\n");
  EXPECT_EQ(events("note,pressure [MPa]\nsample #3,1\n\"a #, or b\",2\n"), "press 1 MPa\npress 2 MPa\n");
}

TEST_F(PressLog, NoPressureTakesTheLoadOff) {
  // The last row has a dwell, so it is not blank.
  EXPECT_EQ(events("pressure [MPa]; dwell [s]\n1;\n0;\n;\n;0\n"), "press 1 MPa\nrelease\nrelease\n");
}

// A forgotten number looks like a release.
TEST_F(PressLog, AnEmptyLoadIsAReleaseWithAWarning) {
  EXPECT_EQ(events("pressure [MPa],rotation [deg]\n1,0\n,90\n1,0\n,45\n"),
            "press 1 MPa\nrelease\nrotate 90 deg\npress 1 MPa\nrelease\nrotate 45 deg\n");
  ASSERT_EQ(listener.all.size(), 1U);
  EXPECT_EQ(listener.all[0], "\"" + path() +
                                 "\": the cell of the pressure is empty in line 3, and so in 1 more: it is "
                                 "read as 0, a release; write 0 to confirm");
  listener.all.clear();
  events("pressure [MPa],rotation [deg]\n1,0\n0,90\n1,0\n");
  EXPECT_TRUE(listener.all.empty());
}

// Twenty minutes do not fit in ten.
TEST_F(PressLog, ADwellThatGoesOnPastTheNextRowIsWarnedOf) {
  events("time [min],pressure [MPa],dwell [min]\n0,1,20\n10,1,5\n15,2,30\n20,0,\n");
  ASSERT_EQ(listener.all.size(), 1U);
  EXPECT_EQ(listener.all[0], "\"" + path() +
                                 "\": the dwell of 1200 s in line 2 ends after the start of line 3, 600 s "
                                 "later, and so in 1 more: both are kept as written");
  listener.all.clear();
  events("time [min],pressure [MPa],dwell [min]\n0,1,10\n10,1,5\n");
  EXPECT_TRUE(listener.all.empty());
}

// 1,250 is a thousand in many countries.
TEST_F(PressLog, ACommaThatMayPartThousandsIsWarnedOf) {
  EXPECT_EQ(events("pressure [MPa];dwell [s]\n1,250;5\n100;5\n"),
            "press 1.25 MPa for 5 s\npress 100 MPa for 5 s\n");
  ASSERT_EQ(listener.all.size(), 1U);
  EXPECT_EQ(listener.all[0],
            "\"" + path() +
                "\" line 2, column 1 (pressure): \"1,250\" may have a decimal comma or separated thousands; "
                "give decimal=\",\" or thousands=\",\"; the comma is read as a decimal sign");
  listener.all.clear();
  for (const char* log : {"pressure [MPa];dwell [s]\n1,250;5\n1,5;5\n", "pressure [MPa];dwell [s]\n0,250;5\n",
                          "pressure [MPa];dwell [s]\n1234,250;5\n", "pressure [MPa],dwell [s]\n1.250,5\n"})
    events(log);
  EXPECT_TRUE(listener.all.empty());
}

TEST_F(PressLog, UnitsOfGaugesAndScalesAreRead) {
  EXPECT_EQ(events("pressure [ksi]\n1\n"), "press 6.89476 MPa\n");
  EXPECT_EQ(events("load [lbf]\n1\n"), "press 4.44822 N\n");
  EXPECT_EQ(events("load [kgf],turn [rev]\n1,0.25\n"), "rotate 90 deg\npress 9.80665 N\n");
}

TEST_F(PressLog, FormsOfLoggersAreRead) {
  const std::string first = "press 1 MPa (at 0 s, ", second = "press 2 MPa (at 900 s, ";
  const std::string utf8 = "time [s],pressure [MPa]\n0,1\n900,2\n";
  std::string utf16 = "\xFF\xFE";
  for (const char c : utf8) utf16 += std::string(1, c) + '\0';
  for (const std::string& log : std::vector<std::string>{
           utf8, utf16, "time,pressure [MPa]\n2026-11-23T10:00:00,1\n2026-11-23T10:15:00,2\n",
           "time;pressure [MPa]\n23.11.2026 10:00:00;1\n23.11.2026 10:15:00;2\n",
           "time,pressure [MPa]\n11/23/2026 10:00 AM,1\n11/23/2026 10:15 AM,2\n",
           "time [hh:mm:ss],pressure [MPa]\n10:00:00,1\n10:15:00,2\n", "time,pressure\ns,MPa\n0,1\n900,2\n",
           "time;pressure\n[min];[MPa]\n0;1\n15;2\n", "Zeit [s];Druck [MPa]\n0;1\n900;2\n",
           "time / s,pressure / MPa\n0,1\n900,2\n", "time_s,stress_MPa\n0,1\n900,2\n",
           "time min,pressure/MPa\n0,1\n15,2\n", "time [s] pressure [MPa]\n0 1\n900 2\n",
           "time [s],pressure [MPa]\n\"0,0\",\"1,0\"\n\"900,0\",\"2,0\"\n",
           "time,pressure\n0 s,1 MPa\n15 min,2000 kPa\n",
           "time [s],pressure [MPa]\n0,1\n900 s,2 MPa\nTotal\n"}) {
    const std::string text = read(log).text();
    EXPECT_NE(text.find(first), std::string::npos) << log << text;
    EXPECT_NE(text.find(second), std::string::npos) << log << text;
  }
  listener.all.clear();
  EXPECT_NE(read("time,pressure [MPa]\n46349.25,1\n46349.265625,2\n").text().find("press 2 MPa (at 1350 s"),
            std::string::npos);
  ASSERT_EQ(listener.all.size(), 1U);
  EXPECT_NE(listener.all[0].find("\"46349.25\", are read as days of a spreadsheet"), std::string::npos);
}

TEST_F(PressLog, FormsThatAreSaid) {
  const auto said = [this](const std::string& log, const TableForm& form) {
    std::string lines;
    const Protocol protocol = read_press_log(SourceFile("log.csv", log), listener, form);
    for (const Protocol::Event& event : protocol.events()) lines += text(event.step) + "\n";
    return lines;
  };
  const std::string wanted = "press 1 kN\npress 2 kN\n";
  TableForm form;
  form.skip = 3;
  EXPECT_EQ(said("Machine 7\nOperator Li\n\ntime [s],load [kN]\n0,1\n900,2\n", form), wanted);
  form = {};
  form.heads = {"time [s]", "load [kN]"};
  EXPECT_EQ(said("0,1\n900,2\n", form), wanted);
  form = {};
  form.names = {{"load", "Wert"}};
  EXPECT_EQ(said("Weg;Wert [kN]\n0;1\n1;2\n", form), wanted);
  form.names = {{"load", "load [kN]"}};
  EXPECT_EQ(said("load [kN],load [N]\n1,990\n2,1980\n", form), wanted);
  form = {};
  form.units = {{"load", "kN"}};
  EXPECT_EQ(said("load\n1\n2\n", form), wanted);
  form = {};
  form.thousands = ',';
  EXPECT_EQ(said("load [N];dwell [s]\n1,000;\n2,000;\n", form), wanted);
  form = {};
  form.names = {{"laod", "Wert"}};
  EXPECT_EQ(error_of([&] { said("Wert [kN]\n1\n", form); }).substr(0, 91),
            "unknown_name: `columns` names `laod`, which is no column of a protocol (did you mean `load`");
  form.names = {{"load", "Wart"}};
  EXPECT_EQ(
      error_of([&] { said("Wert [kN]\n1\n", form); }).substr(0, 101),
      "bad_file: \"log.csv\" has 2 problems\n  line 1: no column is headed \"Wart\", which `columns` calls "
      "`load`");
}

TEST_F(PressLog, FormsThatAreNotReadAreRefusedInWords) {
  const std::vector<std::pair<std::string, std::string>> logs{
      {"time,pressure [MPa]\n03/04/2026 10:00,1\n",
       "column 1 (time): holds dates such as \"03/04/2026 10:00\" with an ambiguous day and month; give "
       "dates=\"day first\""},
      {"time [s],pressure [MPa]\n10:00:03,1\n",
       "line 2, column 1 (time): \"10:00:03\" is a date or a time of day, and the column has the unit "
       "\"s\"; remove the unit from its head to read dates and times"},
      {"time,pressure [MPa]\n2026-11-23,1\nlater,2\n", "line 3, column 1 (time): \"later\" is no date"},
      {"Druck\n1\n", "\"Druck\" (did you mean `pressure [MPa]`?)"},
      {"Machine 7\nOperator Li\n\ntime [s],pressure [MPa]\nnone,1\n0,1\n",
       "begins with words, in line 1, and its column titles are in line 4; put # before the lines above the "
       "titles, delete them, or give skip=3"},
      {"pressure [MPa],dwell [s]\n10 N,1\n", "\"10 N\" is a force where a pressure is wanted"},
      {"pressure,dwell [s]\n10 MPa,1\n5,1\n",
       "line 3, column 1 (pressure): \"5\" has no unit, as the cells above"},
      {"pressure [MPa],dwell [s]\n1,1\nTotal\n2,2\n",
       "line 3: there is 1 cell under 2 heads; put # before a line that is no row"},
      {"load [N],pressure [Pa]\n1,1\n", "begin the title of the other with \"result \""},
      {"load [N],load [kN]\n1,1\n",
       "column 2 (load): has the same meaning as column 1; leave one of them out, or begin its title with "
       "\"result "
       "\""},
      {"\x1F\x8B\x08 log", "is not text that can be read: it is packed with gzip (.gz); unpack it"},
      {"Kraft [kN],Last [kN]\n1,1\n", "column 2 (load): has the same meaning as column 1"},
  };
  for (const auto& [log, words] : logs) {
    const std::string error = refusal(log);
    EXPECT_NE(error.find(words), std::string::npos) << log << "\n" << error;
  }
  // Titles decide between two columns.
  EXPECT_EQ(events("load [N],result pressure [Pa]\n1,1\n"), "press 1 N\n");
  EXPECT_TRUE(listener.all.empty());
}

// An angle is a stage reading, not a turn.
TEST_F(PressLog, AnAngleAmongEventsIsAskedAbout) {
  events("pressure [MPa],angle [deg],dwell [s]\n1,90,1\n");
  ASSERT_EQ(listener.all.size(), 1U);
  EXPECT_NE(listener.all[0].find("\"angle [deg]\" (did you mean `rotation [deg]`?)"), std::string::npos);
}

TEST_F(PressLog, BodiesUnderLoadAreReleasedBeforeTheyAreMoved) {
  EXPECT_EQ(events("pressure [Pa],rotation [deg],place\n0,90,\n5,0,\n5,90,\n,90,\n5,,2\n5,90,3\n"),
            "rotate 90 deg\n"
            "press 5 Pa\n"
            "release\nrotate 90 deg\npress 5 Pa\n"
            "release\nrotate 90 deg\n"
            "place with seed 2\npress 5 Pa\n"
            "release\nplace with seed 3\nrotate 90 deg\npress 5 Pa\n");
}

TEST_F(PressLog, UnknownColumnsAreLeftOutWithAWarning) {
  EXPECT_EQ(events("pressure [MPa],operator,dwel [s]\n1,Li,5\n"), "press 1 MPa\n");
  ASSERT_EQ(listener.all.size(), 1U);
  EXPECT_EQ(listener.all[0], "\"" + path() +
                                 "\" has columns that a protocol does not use: \"operator\", "
                                 "\"dwel [s]\" (did you mean `dwell`?)");
}

TEST_F(PressLog, SampledRecordingsAreWarnedOf) {
  std::string log = "time [s],load [N]\n";
  for (int k = 0; k < 99; ++k) log += std::to_string(k) + ",1\n";
  EXPECT_EQ(read(log).count(), 99U);
  EXPECT_TRUE(listener.all.empty());
  EXPECT_EQ(read(log + "99,1\n").count(), 100U);
  ASSERT_EQ(listener.all.size(), 1U);
  EXPECT_NE(listener.all[0].find("has 100 rows without dwell or turn, and each is read as an event"),
            std::string::npos);
}

TEST_F(PressLog, DwellWithoutLoadIsAWarning) {
  EXPECT_EQ(events("pressure [MPa],dwell [s]\n0,5\n"), "release\n");
  ASSERT_EQ(listener.all.size(), 1U);
  EXPECT_NE(listener.all[0].find("a dwell without load changes nothing, as in line 2"), std::string::npos);
}

TEST_F(PressLog, EqualTimesAreNoStepBack) {
  EXPECT_EQ(read("time [s],pressure [Pa]\n-5,1\n-5,2\n0,3\n").count(), 3U);
}

TEST_F(PressLog, ColumnsThatMeanNothingCertainAreRefused) {
  EXPECT_EQ(refusal("time,pressure [MPa]\n0,1\n"),
            "bad_file: line 1, column 1 (time): has no unit; write \"time [s]\"");
  EXPECT_EQ(refusal("pressure [mm]\n1\n"),
            "bad_file: line 1, column 1 (pressure): has the unit \"mm\" of a length where a pressure is "
            "wanted; write \"pressure [MPa]\"");
  EXPECT_NE(refusal("pressure [MPaa]\n1\n").find("line 1, column 1 (pressure): "), std::string::npos);
  EXPECT_NE(refusal("pressure [MPaa]\n1\n").find("(did you mean `MPa`?)"), std::string::npos);
  EXPECT_EQ(
      refusal("turn [deg],pressure [Pa],rotation [deg]\n0,1,0\n"),
      "bad_file: line 1, column 3 (rotation): has the same meaning as column 1; leave one of them out, or "
      "begin its title with \"result \"");
  EXPECT_EQ(refusal("pressure [Pa],load [N]\n1,1\n"),
            "bad_file: line 1: both `pressure` and `load` are given; choose one, and begin the title of the "
            "other with \"result \" or leave it out");
  EXPECT_EQ(
      refusal("time [s],presure [MPa]\n0,1\n"),
      "bad_file: line 1: no column `pressure` or `load` among others: \"presure [MPa]\" (did you mean "
      "`pressure`?); write \"pressure [MPa]\" or \"load [N]\", or choose one: columns={ load=\"its head\" }");
  EXPECT_EQ(refusal("time [s]\n0\n"),
            "bad_file: line 1: no column `pressure` or `load`; write \"pressure [MPa]\" or \"load [N]\"");
}

TEST_F(PressLog, AllProblemsAreNamedByLineAndColumn) {
  EXPECT_EQ(refusal("time [s],pressure [MPa],rotation [deg],dwell [min],seed\n"
                    "0,-1,x,-2,1.5\n"
                    "5,nan,inf,1,-1\n"
                    "4,1,0,1,\n"
                    ",1,0,1,\n"
                    "6,1\n"
                    "7,1e400,0,1,1,1\n"
                    "8,1,0,1e400,\n"),
            "bad_file: has 12 problems\n"
            "  line 2, column 2 (pressure): \"-1\" is negative\n"
            "  line 2, column 3 (rotation): \"x\" is no number\n"
            "  line 2, column 4 (dwell): \"-2\" is negative\n"
            "  line 2, column 5 (seed): \"1.5\" is no seed; give a whole number from zero up\n"
            "  line 3, column 2 (pressure): \"nan\" is no number\n"
            "  line 3, column 3 (rotation): \"inf\" is no finite number\n"
            "  line 3, column 5 (seed): \"-1\" is no seed; give a whole number from zero up\n"
            "  line 4, column 1 (time): the time 4 s runs backwards, after 5 s\n"
            "  line 5, column 1 (time): the time is missing\n"
            "  line 6: there are 2 cells under 5 heads; put # before a line that is no row\n"
            "  line 7: there are 6 cells under 5 heads; put # before a line that is no row\n"
            "  line 8, column 4 (dwell): \"1e400\" is too large for a number");
  std::string many = "pressure [MPa]\n";
  for (int k = 0; k < 20; ++k) many += "x\n";
  const std::string text = refusal(many);
  EXPECT_NE(text.find("has 20 problems"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("\n  and 8 more")) << text;
}

TEST_F(PressLog, ThousandsAreNotGuessed) {
  EXPECT_EQ(refusal("pressure [Pa],dwell [s]\n\"1,500\",1\n"),
            "bad_file: line 2, column 1 (pressure): \"1,500\" may have a decimal comma or separated "
            "thousands; give decimal=\",\" or thousands=\",\"");
}

TEST_F(PressLog, FilesThatAreNoLogs) {
  EXPECT_NE(refusal("0,152,10\n1,152,10\n").find("begins with numbers, in line 1, and names no columns"),
            std::string::npos);
  EXPECT_NE(refusal("# nothing\n\n").find("holds no line of column titles"), std::string::npos);
  EXPECT_NE(refusal("pressure [Pa]\n# nothing\n").find("names columns but holds no row"), std::string::npos);
  EXPECT_NE(refusal("").find("is empty"), std::string::npos);
  EXPECT_NE(refusal(std::string("p\0r\0", 4)).find("is not text"), std::string::npos);
  EXPECT_NE(error_of([&] { SourceFile(path() + "x", listener); }).find("there is no file"),
            std::string::npos);
}

// Semicolons, decimal commas, Latin-1, CRLF, notes.
TEST_F(PressLog, AFileAsItIsKept) {
  const Protocol p =
      read_press_log(SourceFile(ASPERITY_TEST_DATA "/../data/press_log.csv", listener), listener);
  EXPECT_EQ(p.text(),
            "protocol of 8 events\n"
            "  1  press 1.9098 kN for 10 min (at 0 s, press_log.csv line 4)\n"
            "  2  release (at 900 s, press_log.csv line 5)\n"
            "  3  rotate 90 deg (at 900 s, press_log.csv line 5)\n"
            "  4  press 1.9098 kN for 10 min (at 900 s, press_log.csv line 5)\n"
            "  5  release (at 1800.5 s, press_log.csv line 7)\n"
            "  6  rotate -90 deg (at 1800.5 s, press_log.csv line 7)\n"
            "  7  press 1.9098 kN for 150 s (at 1800.5 s, press_log.csv line 7)\n"
            "  8  release (at 2700 s, press_log.csv line 8)");
  EXPECT_EQ(p.events()[6].origin, "press_log.csv line 7");
  ASSERT_EQ(listener.all.size(), 1U);
  EXPECT_NE(listener.all[0].find("\"Operator\""), std::string::npos);
}

TEST_F(PressLogWriter, WritesWhatAPersonWould) {
  const std::string log =
      "time [s], rotation [deg], pressure [MPa], dwell [min]\n"
      "0, , 152.78, 10\n"
      "900, 90, 152.78, 10\n"
      "1800, , 0, \n";
  EXPECT_EQ(press_log_text(read(log)), log);
}

TEST_F(PressLogWriter, ReadsBackAsItself) {
  using P = Protocol;
  const auto press = [](double value, std::optional<double> dwell = {}) {
    return PressRequest{PressBy::pressure, value, dwell};
  };
  const std::vector<Protocol> all = {
      P({{press(1)}}),
      P({{P::Release{}}}),
      P({{P::Release{}}, {P::Release{}}, {P::Rotate{1}}, {P::Release{}}, {P::Release{}}}),
      P({{press(0.1 + 0.2)}, {press(std::nextafter(152.78e6, 0), 1.0 / 3)}, {P::Release{}}, {P::Release{}}}),
      P({{P::Rotate{1.0 / 3}}, {P::Rotate{-0.1}}, {P::Place{9}}, {P::Rotate{0.7}}, {press(2)}}),
      P({{P::Place{1}}, {P::Place{std::uint64_t{1} << 53}}, {press(2, 0.0)}}),
      P({{press(1)},
         {P::Release{}},
         {P::Place{2}},
         {P::Rotate{1}},
         {press(2)},
         {P::Release{}},
         {P::Rotate{2}}}),
      P({{press(1), 0.1}, {P::Release{}, 0.2}, {P::Rotate{1}, 0.3}, {press(2), 0.4}, {P::Release{}, 0.5}}),
      P({{press(1), 0.1}, {P::Release{}, 0.3}, {P::Rotate{1}, 0.3}, {press(2), 0.3}}),
      P({{PressRequest{PressBy::load, 1e-9 / 3, {}}}, {PressRequest{PressBy::load, 7e20, {}}}}),
      P({{press(1), 5.0}, {press(2)}, {P::Release{}, 1.0}}).plus(P({{press(3)}})),
  };
  for (const Protocol& protocol : all) {
    const std::string log = press_log_text(protocol);
    EXPECT_EQ(read(log).digest(), protocol.digest()) << log << read(log).text();
  }
}

TEST_F(PressLogWriter, TimesAreKeptOnlyIfAllAreKnown) {
  const Protocol some({{PressRequest{PressBy::pressure, 1, {}}, 5.0}, {Protocol::Release{}}});
  EXPECT_EQ(press_log_text(some).find("time"), std::string::npos);
}

TEST_F(PressLogWriter, NamesWhatALogCannotSay) {
  using P = Protocol;
  const PressRequest press{PressBy::pressure, 1, {}};
  const auto refused = [](std::vector<P::Event> events) {
    return error_of([&] { press_log_text(P(std::move(events))); });
  };
  EXPECT_EQ(refused({{press}, {P::Shift{1, 0}}}),
            "bad_value: a press log cannot hold event 2, shift by 1 m along x and 0 m along y: a log has no "
            "column for it");
  EXPECT_EQ(refused({{press}, {PressRequest{PressBy::load, 1, {}}}}),
            "bad_value: a press log cannot hold event 2, press 1 N: a log has pressures or loads, and the "
            "events before give the other");
  EXPECT_NE(
      refused({{PressRequest{PressBy::flatten, 0.1, {}}}}).find("a log presses to a pressure or a load only"),
      std::string::npos);
  EXPECT_NE(refused({{PressRequest{}}}).find("a log reads zero as a release; use a release"),
            std::string::npos);
  EXPECT_NE(refused({{P::Rotate{0}}}).find("a log has no turn by zero"), std::string::npos);
  EXPECT_NE(refused({{P::Place{(std::uint64_t{1} << 53) + 1}}}).find("its seed is above 2^53"),
            std::string::npos);
}

}  // namespace
}  // namespace asperity::press_log_test
