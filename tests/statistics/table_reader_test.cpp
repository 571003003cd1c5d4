// SPDX-License-Identifier: GPL-3.0-or-later
// Tables from loggers and spreadsheets; refusals by line and column.
#include "engine/statistics/table_reader.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "engine/core/quantity.hpp"
#include "tests/support/run_fixture.hpp"
#include "tests/support/warnings.hpp"

namespace asperity::table_reader_test {
namespace {

Table read(const std::string& text, const TableForm& form = {}) {
  return read_measured_table(SourceFile("t.csv", text), form);
}
std::string csv_in_si(Table table) {
  for (const TableColumn& column : std::vector(table.columns()))
    table.declare_unit(column.name, si_unit(parse_unit(column.unit).dimension));
  return table.csv();
}
std::string csv(const std::string& text, const TableForm& form = {}) { return csv_in_si(read(text, form)); }
std::string refusal(const std::string& text, const TableForm& form = {}) {
  const std::string error = error_of([&] { read(text, form); }), name = "bad_file: \"t.csv\" ";
  return error.starts_with(name) ? error.substr(name.size()) : error;
}
TableForm with(void (*set)(TableForm&)) {
  TableForm form;
  set(form);
  return form;
}
double number(const Table& table, std::size_t row, std::size_t column) {
  return std::get<double>(table.cell(row, column));
}

std::string utf16(const std::string& text, bool little) {
  std::string bytes = little ? "\xFF\xFE" : "\xFE\xFF";
  for (const char c : text) {
    if (!little) bytes += '\0';
    bytes += c;
    if (little) bytes += '\0';
  }
  return bytes;
}

TEST(TableReader, NumbersWithUnitsAreInSiAndTheNearestDoubles) {
  const Table table = read("N,load [kN],d (um),angle [deg]\n1,0.1,0.3,180\n2,-2.5,250,\n");
  EXPECT_EQ(table.csv(), "N,load [kN],d [um],angle [deg]\n1,0.1,0.3,180\n2,-2.5,250,\n");
  EXPECT_EQ(csv_in_si(table),
            "N,load [N],d [m],angle [rad]\n1,100,3e-07,3.141592653589793\n2,-2500,0.00025,\n");
  EXPECT_EQ(number(table, 0, 2), 0.3e-6);
  EXPECT_EQ(number(table, 0, 3), std::numbers::pi);
  EXPECT_EQ(std::get<std::int64_t>(table.cell(1, 0)), 2);
  EXPECT_EQ(table.name(), "\"t.csv\"");
}

TEST(TableReader, FormsOfOneTable) {
  const std::string wanted = "time [s],load [N]\n0,1500\n900.5,2250\n";
  for (const std::string text :
       {"time [s],load [kN]\n0,1.5\n900.5,2.25\n",
        "\xEF\xBB\xBFtime [s],load [kN]\r\n0,1.5\r\n900.5,2.25\r\n",
        "time [s];load [kN]\n0;1,5\n900,5;2,25\n", "time [s]\tload [kN]\n0\t1,5\n900,5\t2,25\n",
        "time [s] load [kN]\n0 1.5\n900.5 2.25\n", "time [s]   load [kN]\n  0     1,5\n900,5   2,25\n",
        "time (s),load (kN)\n0,1.5\n900.5,2.25\n", "time / s,load / kN\n0,1.5\n900.5,2.25\n",
        "\"time, s\",\"load, kN\"\n0,1.5\n900.5,2.25\n", "time,load\ns,kN\n0,1.5\n900.5,2.25\n",
        "time;load\n[s];[kN]\n0;1,5\n900,5;2,25\n", "time,load\n0 s,1.5 kN\n900.5 s,2250 N\n",
        "\"time [s]\",\"load [kN]\"\n\"0,0\",\"1,5\"\n\"900,5\",\"2,25\"\n",
        "sep=;\n# kept by hand\n\ntime [s];load [kN];\n0;1,5;\n\n900,5;2,25;\n",
        "time [s],load [kN]\n0,1.5\n900.5,2.25\nEnd\n",
        "time [s],load [N]\n0,\"1,500.0\"\n900.5,\"2,250.0\"\n"}) {
    if (text.front() == '\xEF') continue;
    EXPECT_EQ(csv(utf16(text, true)), wanted) << "UTF-16: " << text;
  }
  EXPECT_EQ(csv(utf16("time [s],load [kN]\n0,1.5\n900.5,2.25\n", false)), wanted);
  EXPECT_EQ(csv(utf16("time [s],load [kN]\n0,1.5\n900.5,2.25\n", true).substr(2)), wanted);
  EXPECT_EQ(csv("Machine 7\nOperator Li\ntime [s],load [kN]\n0,1.5\n900.5,2.25\n",
                with([](TableForm& f) { f.skip = 2; })),
            wanted);
  EXPECT_EQ(csv("0,1.5\n900.5,2.25\n", with([](TableForm& f) {
                  f.heads = {"time [s]", "load [kN]"};
                })),
            wanted);
  EXPECT_EQ(csv("Zeit;Kraft\n0;1,5\n900,5;2,25\n", with([](TableForm& f) {
                  f.names = {{"load", "Kraft"}, {"time", "Zeit"}};
                  f.units = {{"Zeit", "s"}, {"load", "kN"}};
                })),
            wanted);
}

TEST(TableReader, LettersBeyondAsciiAreKept) {
  EXPECT_EQ(csv("Kraft [N];H\xC3\xA4rte;\xCF\x86 [\xC2\xB0]\n1;2;180\n"),
            "Kraft [N],H\xC3\xA4rte,\xCF\x86 [rad]\n1,2,3.141592653589793\n");
  EXPECT_EQ(csv("H\xE4rte;Weg [\xB5m];phi [\xB0]\n2;3;180\n"),
            "H\xC3\xA4rte,Weg [m],phi [rad]\n2,3e-06,3.141592653589793\n");
}

// A letter after a name may belong to the name.
TEST(TableReader, AUnitIsTakenOnlyWhereItCanBeNothingElse) {
  EXPECT_EQ(csv("load kN,slip um,strain %\n1,2,3\n"), "load [N],slip [m],strain\n1000,2e-06,0.03\n");
  EXPECT_EQ(csv("Run N,time_s,T min,mu (left),Ra/Rq,a, b\n1,2,3,4,5,6,7\n"),
            "Run N,time_s,T min,mu (left),Ra/Rq,a,b\n1,2,3,4,5,6,7\n");
  EXPECT_NE(refusal("load\n1\n", with([](TableForm& f) {
                      f.units = {{"load", "kn"}};
                    }))
                .find("line 1, column 1 (load): \"kn\": unknown unit `kn`"),
            std::string::npos);
  EXPECT_EQ(csv("T [\xC2\xB0"
                "C]\n1.5\n",
                with([](TableForm& f) {
                  f.units = {{"T", "1"}};
                })),
            "T\n1.5\n");
}

std::vector<std::string> warnings_of(const std::string& text, const TableForm& form = {}) {
  test::Warnings warnings;
  read_measured_table(SourceFile("t.csv", text), form, warnings);
  return warnings.all;
}

TEST(TableReader, AnUnknownUnitStaysInTheHead) {
  EXPECT_EQ(csv("x [s],T [degC]\n1,20\n"), "x [s],T [degC]\n1,20\n");
  EXPECT_EQ(warnings_of("x [s],T [degC],U [mV]\n1,20,3\n"),
            (std::vector<std::string>{
                "\"t.csv\": the units \"degC\" of column 2 (T) and \"mV\" of column 3 (U) are not known; the "
                "numbers are read without a unit, and the heads keep them"}));
  EXPECT_EQ(warnings_of("T [degC]\n20\n").size(), 1u);
  EXPECT_EQ(csv("time,T,load\ns,degC,kN\n1,20,5\n2,21,6\n"),
            "time [s],T [degC],load [N]\n1,20,5000\n2,21,6000\n");
  EXPECT_EQ(warnings_of("time,T,load\ns,degC,kN\n1,20,5\n2,21,6\n").size(), 1u);
  EXPECT_EQ(csv("time;T\n[s];[\xB0"
                "C]\n1;20,5\n"),
            "time [s],T [\xC2\xB0"
            "C]\n1,20.5\n");
  EXPECT_EQ(csv("T,U\n[K],[V]\n20,1\n"), "T [K],U [V]\n20,1\n");
  // By the new name and the file's name.
  EXPECT_EQ(csv("Temp [degC]\n20\n", with([](TableForm& f) { f.names = {{"T", "Temp"}}; })), "T\n20\n");
  EXPECT_EQ(csv("time,T\ns,degC\n1,20\n", with([](TableForm& f) {
                  f.units = {{"T", "1"}};
                })),
            "time [s],T\n1,20\n");
  EXPECT_EQ(csv(csv("x [s],T [degC]\n1,20\n")), "x [s],T [degC]\n1,20\n");
  // Words below words are rows.
  EXPECT_EQ(csv("name,kind\nAnna,m\nBea,f\n"), "name,kind\nAnna,m\nBea,f\n");
  EXPECT_EQ(csv("tag,load\nm,1 N\nf,2 N\n"), "tag,load [N]\nm,1\nf,2\n");
}

TEST(TableReader, ARowOfDataIsNeverTheHeads) {
  const std::string cure =
      ", in line 1, and names no columns; give their heads, as in columns={ \"time [s]\", \"load [kN]\" }";
  EXPECT_EQ(refusal("2026-01-01 08:00,1.5\n2026-01-01 09:00,1.6\n"),
            "begins with \"2026-01-01 08:00\"" + cure);
  EXPECT_EQ(refusal("new,1.5\nold,1.6\n"), "begins with \"1.5\"" + cure);
  EXPECT_EQ(refusal("new;1,5\nold;1,6\n"), "begins with \"1,5\"" + cure);
  EXPECT_EQ(refusal("\"08:00:01\",\"x\"\n\"08:00:02\",\"y\"\n"), "begins with \"08:00:01\"" + cure);
  EXPECT_EQ(refusal("1'250;x\n2'000;y\n"), "begins with \"1'250\"" + cure);
  EXPECT_EQ(refusal("1.5 kN,2 s\n1.6 kN,3 s\n"), "begins with \"1.5 kN\"" + cure);
  // Heads similar to a number or date.
  for (const std::string heads : {"E1,e2", "slip,10 N", "day 1,95%", "x1,May", "1st,nan", "A-1,B-2"})
    EXPECT_EQ(csv(heads + "\n1,2\n").substr(0, 2), heads.substr(0, 2));
}

TEST(TableReader, ColumnsOfFixedWidthAreParted) {
  const std::string wanted = "load [N],Ra [m]\n1,5e-07\n2,6e-07\n";
  for (const char* units : {"    [N]     [um]\n", "      N       um\n"})
    EXPECT_EQ(csv(std::string("   load       Ra\n") + units + "    1.0      0.5\n    2.0      0.6\n"),
              wanted);
  EXPECT_EQ(csv("   load        T\n    [N]   [degC]\n    1.0     20.5\n"), "load [N],T [degC]\n1,20.5\n");
  EXPECT_EQ(csv("note text\nworn and old\nnew\n"), "note text\nworn and old\nnew\n");
}

TEST(TableReader, BytesOfWindowsAreItsCharacters) {
  EXPECT_EQ(csv("load [N],note\n1,a \x96 b\n2,\x80 5\n"),
            "load [N],note\n1,a \xE2\x80\x93 b\n2,\xE2\x82\xAC 5\n");
  EXPECT_EQ(csv("n,note\n1,\x81\xE4\n"), "n,note\n1,\xEF\xBF\xBD\xC3\xA4\n");
}

// Only the key distinguishes the autumn clock change from unordered rows.
TEST(TableReader, LocalTimesThatStepBackAreWarnedOfAndCured) {
  const TableForm winter = with([](TableForm& f) { f.steps_back = StepsBack::winter_time; });
  const std::string quarters =
      "stamp,F [N]\n2025-10-26 02:45:00,1\n2025-10-26 02:00:00,2\n2025-10-26 02:15:00,3\n2025-10-26 "
      "03:00:00,4\n";
  EXPECT_EQ(warnings_of(quarters),
            (std::vector<std::string>{"\"t.csv\" line 3, column 1 (stamp): \"2025-10-26 02:00:00\" is before "
                                      "the time above; if summer time "
                                      "ended between them, steps_back=\"winter time\" adds the hour"}));
  EXPECT_EQ(csv(quarters, winter), "stamp [s],F [N]\n0,1\n900,2\n1800,3\n4500,4\n");
  EXPECT_TRUE(warnings_of(quarters, winter).empty());
  const std::string hours =
      "t,F\n2025-10-26 01:00,1\n2025-10-26 02:00,2\n2025-10-26 02:00,3\n2025-10-26 03:00,4\n";
  EXPECT_EQ(warnings_of(hours).size(), 1u);
  EXPECT_EQ(csv(hours, winter), "t [s],F\n0,1\n3600,2\n7200,3\n10800,4\n");
  // No warning: zones, larger steps back, repeated times.
  for (const std::string rows :
       {"2025-10-26 02:45+02:00,1\n2025-10-26 02:00+01:00,2\n", "2026-03-01,1\n2026-02-28,2\n",
        "2026-03-01 10:00,1\n2026-03-01 10:00,2\n2026-03-01 11:00,1\n2026-03-01 11:00,2\n",
        "2026-03-01,1\n2026-03-02,1\n2026-03-02,2\n"}) {
    EXPECT_TRUE(warnings_of("t,F\n" + rows).empty()) << rows;
    EXPECT_EQ(csv("t,F\n" + rows, winter), csv("t,F\n" + rows)) << rows;
  }
  // Jitter of a logger: a warning, no added hour.
  const std::string jitter = "t,F\n2026-03-01 10:00:00.2,1\n2026-03-01 10:00:00.1,2\n";
  EXPECT_EQ(warnings_of(jitter).size(), 1u);
  EXPECT_EQ(csv(jitter, winter), csv(jitter));
}

TEST(TableReader, MidnightIsAddedWhereItIsSaid) {
  const TableForm midnight = with([](TableForm& f) { f.steps_back = StepsBack::midnight; });
  const std::string text = "time,a\n23:59:00,1\n00:01:00,2\n13:00:00,3\n00:00:30,4\n";
  EXPECT_EQ(csv(text, midnight), "time [s],a\n0,1\n120,2\n46860,3\n86490,4\n");
  EXPECT_TRUE(warnings_of("time,a\n23:59:00,1\n00:01:00,2\n", midnight).empty());
  EXPECT_NE(warnings_of(text).at(0).find("steps_back=\"midnight\" adds the day"), std::string::npos);
}

TEST(TableReader, ARemarkAfterTheUnitStaysInTheName) {
  EXPECT_EQ(csv("Force (kN, filtered);F (N, raw);d [um, mean]\n1;2;3\n"),
            "Force (filtered) [N],F (raw) [N],d (mean) [m]\n1000,2,3e-06\n");
  EXPECT_EQ(csv("\"Group (min, max)\",\"mu (left, cold)\"\n1,2\n"),
            "\"Group (min, max)\",\"mu (left, cold)\"\n1,2\n");
  // Without quotes, the cells below count the heads.
  EXPECT_EQ(csv("time (s),Force (kN, filtered)\n0,1\n1,2\n"),
            "time [s],Force (filtered) [N]\n0,1000\n1,2000\n");
}

TEST(TableReader, ALastLineThatIsCutIsWarnedOf) {
  for (const char* end : {"2;1.", "2;", "2;1,", "2;1e"})
    EXPECT_EQ(warnings_of(std::string("a;b\n1;1,5\n") + (end == std::string("2;1e") ? "3;x\n" : "") + end,
                          with([](TableForm& f) { f.texts = {"b"}; }))
                  .size(),
              1u)
        << end;
  EXPECT_EQ(warnings_of("a;b\n1;0.5\n2;1."),
            (std::vector<std::string>{
                "\"t.csv\", line 3: the last line has no line end and its last cell is \"1.\"; "
                "the file may be cut short"}));
  EXPECT_TRUE(warnings_of("a;b\n1;0.5\n2;1.5").empty());
  EXPECT_TRUE(warnings_of("a;b\n1;0.5\n2;\n").empty());
  EXPECT_TRUE(warnings_of("a;b\n1;1.\n2;2.").empty());
}

TEST(TableReader, NumbersThatLookLikeNamesAreWarnedOf) {
  EXPECT_EQ(warnings_of("id,x\n007,1\n012,2\n"),
            (std::vector<std::string>{"\"t.csv\" line 2, column 1 (id): \"007\" is read as a number, which "
                                      "loses its zeros; text={ \"id\" } reads it unchanged"}));
  EXPECT_EQ(csv("id,x\n007,1\n012,2\n"), "id,x\n7,1\n12,2\n");
  // The first with a zero; empty cells do not matter.
  EXPECT_EQ(warnings_of("id,x\n123,1\n,2\n045,3\n").at(0).substr(0, 35),
            "\"t.csv\" line 4, column 1 (id): \"045");
  // No names: without zeros, of two digits, of several lengths, with a sign or a point.
  for (const std::string rows : {"123\n456\n", "01\n12\n", "007\n12\n", "+07\n012\n", "0.7\n012\n", "0\n1\n"})
    EXPECT_TRUE(warnings_of("id\n" + rows).empty()) << rows;
  EXPECT_TRUE(warnings_of("id\n007\n012\n", with([](TableForm& f) { f.texts = {"id"}; })).empty());
  // A double has 15 digits; whole numbers up to 2^53 are exact in a column of whole numbers.
  EXPECT_NE(warnings_of("id\n1234567890123456\n0.5\n").at(0).find("loses digits"), std::string::npos);
  EXPECT_NE(warnings_of("id\n9007199254740993\n").at(0).find("loses digits"), std::string::npos);
  for (const std::string rows : {"123456789012345\n0.5\n", "9007199254740992\n"})
    EXPECT_TRUE(warnings_of("id\n" + rows).empty()) << rows;
}

TEST(TableReader, RowsBeforeTheFirstWholeOneAreTakenForLinesAboveTheHeads) {
  const std::string above = "; give the number of lines above the heads as skip=";
  EXPECT_EQ(refusal("a,b\n1,2,3\n4,5,6\n7,8\n9\n"),
            "has 3 problems\n  line 2: there are 3 cells under 2 heads" + above +
                "\n  line 3: there are 3 cells under 2 heads" + above +
                "\n  line 5: there is 1 cell under 2 heads; put # before a line that is no row");
}

TEST(TableReader, ApostrophesBetweenDigitsAreAskedForAndRead) {
  const TableForm form = with([](TableForm& f) { f.thousands = '\''; });
  for (const std::string sign : {"'", "\u2019"}) {
    EXPECT_EQ(refusal("a;b\n1" + sign + "234.5;2\n"),
              "line 2, column 1 (a): \"1'234.5\" has an apostrophe between its digits; give thousands=\"'\" "
              "if it separates thousands");
    EXPECT_EQ(csv("a;b [N]\n1" + sign + "234.5;2" + sign + "000\n", form), "a,b [N]\n1234.5,2000\n");
  }
}

TEST(TableReader, ColumnsOfTextsTruthsAndNothing) {
  const Table table = read("tag,ok,mu,note\nnew,true,0.4,\n\"worn, old\",false,NaN,\"\"\n\"'=1+1\",,-,x\n");
  EXPECT_EQ(table.csv(), "tag,ok,mu,note\nnew,true,0.4,\n\"worn, old\",false,,\"\"\n\"'=1+1\",,,x\n");
  EXPECT_EQ(std::get<std::string>(table.cell(2, 0)), "=1+1");
  EXPECT_EQ(std::get<bool>(table.cell(1, 1)), false);
  EXPECT_TRUE(is_empty(table.cell(0, 3)));
  EXPECT_EQ(refusal("tag\n1\n2\nnew\n4\nold\n"),
            "line 4, column 1 (tag): \"new\" is no number, unlike others of this column (and 1 more lines); "
            "correct it, or read the column as texts by text={ \"tag\" }");
  EXPECT_EQ(csv("tag\n1\nnew\n", with([](TableForm& f) { f.texts = {"tag"}; })), "tag\n1\nnew\n");
}

TEST(TableReader, ReadsBackWhatATableWrites) {
  const Table table(
      {{"N", ""}, {"x", "m"}, {"tag", ""}, {"ok", ""}},
      {{std::int64_t{100000}, std::nextafter(0.1, 1.0), std::string("=a"), true},
       {std::int64_t{-2}, -std::numeric_limits<double>::infinity(), std::string("a,\"b\""), false},
       {Cell(), 0.0, Cell(), Cell()},
       {std::int64_t{3}, 5e-324, std::string(), true}});
  EXPECT_EQ(read(table.csv()).csv(), table.csv());
  EXPECT_EQ(read(table.csv()).digest(), table.digest());
  std::vector<std::vector<Cell>> rows;
  double value = 1.2345678901234567e-6;
  for (int k = 0; k < 200; ++k) rows.push_back({value = std::nextafter(value * 1.03, 1.0), value});
  const Table converted({{"d", "um"}, {"p", "MPa/um"}}, rows);
  EXPECT_EQ(read(converted.csv()).digest(), converted.digest());
  EXPECT_EQ(csv("a,b\n1,2\n,\n3,4\n"), "a,b\n1,2\n3,4\n");  // spreadsheets write empty lines like this
}

TEST(TableReader, ACommaIsReadWhereTheFileTellsWhatItIs) {
  // One unambiguous number decides for all.
  EXPECT_EQ(csv("a;b\n1,250;0,5\n"), "a,b\n1.25,0.5\n");
  EXPECT_EQ(csv("a;b\n1.250,5;1.000\n"), "a,b\n1250.5,1000\n");
  EXPECT_EQ(csv("a;b\n1,250.5;1,000\n"), "a,b\n1250.5,1000\n");
  EXPECT_EQ(csv("a;b\n1,250,000;1\n"), "a,b\n1250000,1\n");
  EXPECT_EQ(refusal("a;b\n1,250;2\n"),
            "line 2, column 1 (a): \"1,250\" may have a decimal comma or separated thousands; give "
            "decimal=\",\" or thousands=\",\"");
  EXPECT_EQ(csv("a;b\n1,250;2\n", with([](TableForm& f) { f.decimal = ','; })), "a,b\n1.25,2\n");
  EXPECT_EQ(csv("a;b\n1,250;2\n", with([](TableForm& f) { f.thousands = ','; })), "a,b\n1250,2\n");
  EXPECT_EQ(csv("a;b\n1 250;2'000\n", with([](TableForm& f) {
                  f.thousands = ' ';
                  f.texts = {"b"};
                })),
            "a,b\n1250,2'000\n");
  EXPECT_EQ(csv("a;b\n2'000;1\n", with([](TableForm& f) { f.thousands = '\''; })), "a,b\n2000,1\n");
  EXPECT_EQ(refusal("a;b\n0,5;2\n1.5;2\n"),
            "line 3, column 1 (a): \"1.5\" has a point as its decimal sign, and the others have a comma; "
            "write all "
            "numbers in one way");
  EXPECT_EQ(refusal("a;b\n0,5;1.250\n"),
            "line 2, column 2 (b): \"1.250\" has a point, and the decimal sign is a comma; give "
            "thousands=\".\" if it separates thousands");
  EXPECT_EQ(refusal("a;b\n0.5;1,250\n"),
            "line 2, column 2 (b): \"1,250\" has a comma, and the decimal sign is a point; give "
            "thousands=\",\" if it separates thousands");
  EXPECT_EQ(csv("a;b\n1.250;2.500\n"), "a,b\n1.25,2.5\n");
}

TEST(TableReader, BlanksBetweenDigitsAreAskedForAndRead) {
  const TableForm blanks = with([](TableForm& f) { f.thousands = ' '; });
  for (const char* blank : {" ", "\u00A0", "\u202F"}) {
    const std::string number = std::string("1") + blank + "250";
    EXPECT_EQ(refusal("a;b\n" + number + ";2\n"),
              "line 2, column 1 (a): \"1 250\" has a blank between its digits; give thousands=\" \" if it "
              "separates thousands");
    EXPECT_EQ(csv("a;b\n" + number + ";2\n", blanks), "a,b\n1250,2\n");
    EXPECT_EQ(csv("a;b\n" + number + ",5;2\n", blanks), "a,b\n1250.5,2\n");
  }
  EXPECT_EQ(csv("a;b\n\u22121.5;2\n"), "a,b\n-1.5,2\n");
  EXPECT_EQ(csv("a;b\n\u22121,5;2\n"), "a,b\n-1.5,2\n");
}

TEST(TableReader, NoRowIsLostToWhatASpreadsheetWrites) {
  // A failed cell begins with a comment mark.
  EXPECT_EQ(refusal("a,b\n1,2\n#DIV/0!,4\n"),
            "line 3, column 1 (a): \"#DIV/0!\" is no number, unlike others of this column; correct it, or "
            "read the column as texts by text={ \"a\" }");
  EXPECT_EQ(refusal("a,b\n1,2\n3,#VALUE! # why\n").substr(0, 40),
            "line 3, column 2 (b): \"#VALUE!\" is no nu");
  EXPECT_EQ(csv("a,b\n1,2\n3,#N/A\n#N/A,4\n"), "a,b\n1,2\n3,\n,4\n");
  EXPECT_EQ(csv("a,b\n1,2\n# 3,4\n5,6\n"), "a,b\n1,2\n5,6\n");
  // Looks like a table with one column.
  EXPECT_EQ(refusal("Machine\nOp Li\n\na [N],b\n1,2\n").substr(0, 106),
            "has 2 problems\n  line 4: there are 2 cells under 1 head; give the number of lines above the "
            "heads as skip=");
}

TEST(TableReader, QuotedCellsGoOnOverLines) {
  const std::string table = "a,b\n1,\"x\ny\"\n2,z\n";
  EXPECT_EQ(csv("a,b\n1,\"x\ny\"\n2,z\n"), table);
  EXPECT_EQ(csv("a,b\r\n1,\"x\r\ny\"\r\n2,z\r\n"), table);
  EXPECT_EQ(csv("a,b\r\n1,\"x\ny\"\r\n2,z\r\n"), table);
  EXPECT_EQ(csv("a,b\r1,\"x\ry\"\r2,z\r"), table);
  EXPECT_EQ(csv("a;b\n1; \"x\ny\" # why\n2;z"), table);
  EXPECT_EQ(csv("a\tb\n1\t\"x\ny\"\n2\tz\n"), table);
  EXPECT_EQ(read(utf16("a,b\n1,\"x\ny\"\n2,z\n", true)).csv(), table);
  EXPECT_EQ(csv("a,b\r\r\n1,\"x\r\r\ny\"\r\r\n2,z\r\r\n"), table);
  const std::string all = "n,words,more\n1,\"x, \"\"y\"\"\n\n# no comment; z\",\"u\nv\"\n2,w,w\n";
  EXPECT_EQ(csv(all), all);
  EXPECT_EQ(csv("words,n\n\"x\ny\",1\n"), "words,n\n\"x\ny\",1\n");
  EXPECT_EQ(std::get<std::string>(read(csv("a,b\n1,\"\r\n x\n\"\n")).cell(0, 1)), "\n x\n");
}

TEST(TableReader, HeadsGoOnOverLines) {
  EXPECT_EQ(csv("N,\"load\n[kN]\",\"d\r\n(um)\"\n1,0.1,250\n"), "N,load [N],d [m]\n1,100,0.00025\n");
  EXPECT_EQ(csv("N;\"load\n[kN]\"\n1;0,1\n"), "N,load [N]\n1,100\n");
  EXPECT_EQ(csv("N\t\"load\n[kN]\"\n1\t0.1\n"), "N,load [N]\n1,100\n");
}

TEST(TableReader, LinesAfterACellOfSeveralAreCountedRight) {
  EXPECT_EQ(refusal("a [N],\"b\nc\"\n1,\"x\n\ny\"\nfast,z\n"), "line 6, column 1 (a): \"fast\" is no number");
  EXPECT_EQ(refusal("a [N],b\n1,\"x\ny\"\nfast,\"u\nv\"\n"), "line 4, column 1 (a): \"fast\" is no number");
  EXPECT_EQ(refusal("a [N],b\n1,\"x\ny\"\n2,z,3\n").substr(0, 39), "line 4: there are 3 cells under 2 heads");
}

TEST(TableReader, AQuoteThatIsClosedNowhereOrFarBelowIsRefused) {
  const std::string cure = "; close it at the end of its cell, or remove it";
  EXPECT_EQ(refusal("a,b\n1,\"x\n2,z\n"), "has a quote in line 2 that is never closed" + cure);
  const std::string far = "; close the quote at the end of its cell, or remove it";
  EXPECT_EQ(refusal("a,b\n1,\"x\n2,y\n3,\"z\"\n"),
            "has a quote in line 2 that is closed in line 4, where no cell ends" + far);
  EXPECT_EQ(refusal("a,b\n1,\"x\n2,y\n3,z\",4\n5,w\n"),
            "has a quote in line 2 that is closed in line 4, where the row has 3 cells under 2 heads" + far);
  // Inches are no quotes; words below the table may be.
  EXPECT_EQ(csv("a,b\n1,5\" pipe\n2,z\n"), "a,b\n1,\"5\"\" pipe\"\n2,z\n");
  EXPECT_EQ(csv("a,b\n1,2\n\"measured\nby Li\"\n"), "a,b\n1,2\n");
}

// One search for a following row, not one per quote: minutes otherwise.
TEST(TableReader, ManyQuotesAreGoneOverOnce) {
  std::string quotes = "a,b\n";
  for (int k = 0; k < 200000; ++k) quotes += "\"\n";
  EXPECT_NE(refusal(quotes).find("line 2: there is 1 cell under 2 heads"), std::string::npos);
}

// Lines above a table with another separator look like rows.
TEST(TableReader, ATableBelowWordsIsNotTakenForAFooter) {
  EXPECT_EQ(refusal("Logger X\nSerial 5\nload [kN],time [s]\n1.5,0\n2.5,1\n"),
            "line 3: there are 3 cells under 2 heads; give the number of lines above the heads as skip=");
  EXPECT_EQ(csv("a,b\n1,2\nend of the measurement\nby Li on 4 May\n"), "a,b\n1,2\n");
}

TEST(TableReader, TimesOfDayThatFallByHalfADayAreWarnedOf) {
  const auto warnings = [](const std::string& text) {
    class Counter final : public Monitor {
     public:
      void progress(std::string_view, double) override {}
      void warn(std::string_view sentence) override {
        count += sentence.find("is more than half a day before") != std::string_view::npos;
      }
      std::size_t count = 0;
    } counter;
    read_measured_table(SourceFile("t.csv", text), {}, counter);
    return counter.count;
  };
  EXPECT_EQ(warnings("time,a\n23:59:59,1\n00:00:01,2\n00:00:03,3\n"), 1u);
  EXPECT_EQ(warnings("time,a\n10:59:59,1\n10:00:01,2\n"), 0u);
  EXPECT_EQ(warnings("time,a\n2026-11-23 23:59:59,1\n2026-11-22 00:00:01,2\n"), 0u);
}

TEST(TableReader, StampsAreSecondsFromTheFirst) {
  const std::string wanted = "time [s],x\n0,1\n900,2\n5400.5,3\n";
  for (const std::string text :
       {"time,x\n2026-11-23T10:00:00,1\n2026-11-23T10:15:00,2\n2026-11-23T11:30:00.5,3\n",
        "time,x\n2026-11-23 10:00:00+01:00,1\n2026-11-23 09:15Z,2\n2026-11-23 11:30:00.5+0100,3\n",
        "time,x\n20261123T100000,1\n20261123T101500,2\n20261123T113000.5,3\n",
        "time;x\n23.11.2026 10:00:00;1\n23.11.2026 10:15;2\n23.11.2026 11:30:00,5;3\n",
        "time;x\n23.11.26 10:00:00;1\n23.11.26 10:15;2\n23.11.26 11:30:00,5;3\n",
        "time,x\n11/23/2026 10:00 AM,1\n11/23/2026 10:15 AM,2\n11/23/2026 11:30:00.5 am,3\n",
        "time,x\n23/11/2026 10:00,1\n23/11/2026 10:15,2\n23/11/2026 11:30:00.5,3\n",
        "time,x\n23-Nov-2026 10:00:00,1\n23-Nov-2026 10:15:00,2\n23 Nov 2026 11:30:00.5,3\n",
        "time [hh:mm:ss],x\n23:00:00,1\n23:15:00,2\n24:30:00.5,3\n"}) {
    EXPECT_EQ(csv(text), wanted) << text;
  }
  EXPECT_EQ(csv("day,x\n2026-03-01,1\n2026-02-28,2\n"), "day [s],x\n0,1\n-86400,2\n");
  EXPECT_EQ(csv("day,x\n2026-11-23,1\n", with([](TableForm& f) { f.stamps_since_1970 = true; })),
            "day [s],x\n1795392000,1\n");
  EXPECT_EQ(csv("day,x\n46349.25,1\n46349.5,2\n", with([](TableForm& f) {
                  f.units = {{"day", "date"}};
                })),
            "day [s],x\n0,1\n21600,2\n");
}

TEST(TableReader, DatesThatCanBeReadInTwoWaysAreAskedFor) {
  EXPECT_EQ(
      refusal("day,x\n03/04/2026,1\n05/04/2026,2\n"),
      "line 2, column 1 (day): holds dates such as \"03/04/2026\" with an ambiguous day and month; give "
      "dates=\"day first\" or dates=\"month first\"");
  EXPECT_EQ(
      csv("day,x\n03/04/2026,1\n05/04/2026,2\n", with([](TableForm& f) { f.dates = DateOrder::day_first; })),
      "day [s],x\n0,1\n172800,2\n");
  EXPECT_EQ(csv("day,x\n03/04/2026,1\n05/04/2026,2\n",
                with([](TableForm& f) { f.dates = DateOrder::month_first; })),
            "day [s],x\n0,1\n5270400,2\n");
  // The third date decides.
  EXPECT_EQ(csv("day,x\n03/04/2026,1\n05/04/2026,2\n13/04/2026,3\n"), "day [s],x\n0,1\n172800,2\n864000,3\n");
  EXPECT_EQ(refusal("day,x\n13/04/2026,1\n04/13/2026,2\n"),
            "line 3, column 1 (day): \"04/13/2026\" is in no calendar with the day first");
  EXPECT_EQ(refusal("day,x\n2026-02-29,1\n"), "line 2, column 1 (day): \"2026-02-29\" is in no calendar");
  EXPECT_EQ(refusal("t,x\n10:30,1\n"),
            "line 2, column 1 (t): holds times such as \"10:30\", hours and minutes or minutes and seconds; "
            "give clock=\"h:min\" or clock=\"min:s\"");
  EXPECT_EQ(csv("t,x\n10:30,1\n11:00,2\n", with([](TableForm& f) { f.clock = ClockForm::minutes_seconds; })),
            "t [s],x\n0,1\n30,2\n");
  EXPECT_EQ(refusal("t,x\n2026-02-28,1\n10:00:00,2\n"),
            "line 3, column 1 (t): \"10:00:00\" has no date, which the first one has");
}

TEST(TableReader, TwoColumnsOfOneNameAreChosenFrom) {
  const std::string both = "load [kN],load [N]\n1,990\n";
  EXPECT_EQ(
      refusal(both),
      "line 1, column 2 (load): has the name of column 1; choose one, as in columns={ load=\"load [N]\" }");
  EXPECT_EQ(csv(both, with([](TableForm& f) { f.names = {{"load", "load [N]"}}; })), "load [N]\n990\n");
  EXPECT_EQ(csv(both, with([](TableForm& f) {
                  f.names = {{"load", "load [kN]"}, {"second", "load [N]"}};
                })),
            "load [N],second [N]\n1000,990\n");
  EXPECT_EQ(refusal(both, with([](TableForm& f) {
                      f.names = {{"F", "load"}};
                    }))
                .substr(0, 91),
            "has 2 problems\n  line 1: 2 columns are headed \"load\", which `columns` calls `F`; give the h");
  EXPECT_EQ(refusal("load\n1\n", with([](TableForm& f) {
                      f.names = {{"F", "laod"}};
                    })),
            "line 1: no column is headed \"laod\", which `columns` calls `F` (did you mean `load`?)");
  EXPECT_EQ(refusal("load\n1\n", with([](TableForm& f) {
                      f.units = {{"laod", "N"}};
                    })),
            "line 1: `unit` names `laod`, which is no column (did you mean `load`?)");
}

TEST(TableReader, EveryProblemIsToldByLineAndColumn) {
  EXPECT_EQ(refusal("load [N],t [s]\n1,2\nx,3\n5 MPa,4\n6,10:00:00\n7,1e999\n8,9,10\n"),
            "line 7: there are 3 cells under 2 heads; put # before a line that is no row");
  EXPECT_EQ(refusal("load [N],t [s]\n1,2\nx,3\n5 MPa,4\n6,10:00:00\n7,1e999\n"),
            "has 4 problems\n"
            "  line 3, column 1 (load): \"x\" is no number\n"
            "  line 4, column 1 (load): \"5 MPa\" is a pressure where a force is wanted\n"
            "  line 5, column 2 (t): \"10:00:00\" is a date or a time of day, and the column has the unit "
            "\"s\"; remove the unit from its head to read dates and times\n"
            "  line 6, column 2 (t): \"1e999\" is too large for a number");
  EXPECT_EQ(
      refusal("1,2\n3,4\n"),
      "begins with numbers, in line 1, and names no columns; give their heads, as in columns={ \"time [s]\", "
      "\"load [kN]\" }");
  EXPECT_EQ(refusal("Machine 7\nload [N],t [s]\n1,2\n").substr(0, 65),
            "has 2 problems\n  line 2: there are 2 cells under 1 head; give the");
  EXPECT_EQ(refusal("# nothing\n\n").substr(0, 22), "holds no line of heads");
  EXPECT_EQ(refusal("a,b\n"), "names columns but holds no row");
  EXPECT_EQ(refusal("a,,b\n1,2,3\n"),
            "line 2, column 2 (): \"2\" has no head; give column 2 a head, or empty the cell");
  EXPECT_EQ(csv("a,,b\n1,,3\n"), "a,b\n1,3\n");
  EXPECT_EQ(refusal("a\n1\n", with([](TableForm& f) { f.skip = 5; })), "has 2 lines, and skip=5 leaves none");
  EXPECT_EQ(refusal(std::string("ab\0cd", 5)).substr(0, 11), "is not text");
  EXPECT_EQ(refusal("t\n1 s\n2 m\n"), "line 3, column 1 (t): \"2 m\" is a length where a time is wanted");
}

}  // namespace
}  // namespace asperity::table_reader_test
