// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/recording/press_recording.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "engine/recording/log_table.hpp"

namespace asperity {

namespace {

enum RecordedMeaning { at_time, of_load, of_pressure, of_angle, of_dwell, of_place, of_turn };
constexpr std::array<LogColumn, 9> recording_columns{
    {{"time", at_time, dimension::time, "time [s]"},
     {"load", of_load, dimension::force, "load [N]"},
     {"pressure", of_pressure, dimension::pressure, "pressure [MPa]"},
     {"angle", of_angle, dimension::angle, "angle [deg]"},
     {"rotation", of_angle, dimension::angle, "rotation [deg]"},
     {"dwell", of_dwell, dimension::time, "dwell [min]"},
     {"place", of_place, dimension::number, "place"},
     {"seed", of_place, dimension::number, "seed"},
     {"turn", of_turn, dimension::angle, "turn [deg]"}}};

class RecordingReader {
 public:
  RecordingReader(const SourceFile& file, Monitor& monitor, const TableForm& form, EqualTimes equal_times)
      : file_(file), monitor_(monitor), equal_times_(equal_times), table_(file, recording_columns, form) {
    recording_.name = std::filesystem::path(file.path()).filename().string();
  }

  PressRecording read() {
    table_.read_titles();
    check_columns();
    table_.fail_if_any();
    const auto rows = static_cast<std::size_t>(std::count_if(file_.bytes().begin(), file_.bytes().end(),
                                                             [](char c) { return c == '\n' || c == '\r'; }));
    recording_.time.reserve(rows);
    recording_.load.reserve(rows);
    recording_.line.reserve(rows);
    if (angle_) recording_.angle.reserve(rows);
    table_.read_rows(monitor_, [this](const std::vector<TableCell>& cells) { return read_row(cells), true; });
    table_.fail_if_any();
    if (recording_.time.empty()) refuse_file(file_, "names columns but holds no row", "a row is a sample");
    for (const std::string& warning : table_.warnings()) monitor_.warn(warning);
    spread_equal_times();
    return std::move(recording_);
  }

 private:
  void check_columns() {
    const std::string others = table_.others();
    if (!table_.has(at_time))
      table_.problem(table_.here(), "no column `time`, and events need one" +
                                        (others.empty() ? std::string() : ", among others: " + others) +
                                        "; write \"time [s]\"");
    table_.require_one_of(of_pressure, of_load);
    for (const RecordedMeaning meaning : {of_dwell, of_place, of_turn})
      if (const auto k = table_.find(meaning))
        table_.problem(table_.here(*k),
                       "a recording has no such column: its dwells and turns are detected; read the table "
                       "with events=\"rows\", or leave the column out");
    if (table_.problems() > 0) return;
    table_.warn_of_others(monitor_);
    time_ = *table_.find(at_time);
    recording_.by = table_.has(of_load) ? PressBy::load : PressBy::pressure;
    load_ = *table_.find(table_.has(of_load) ? of_load : of_pressure);
    angle_ = table_.find(of_angle);
  }

  void read_row(const std::vector<TableCell>& cells) {
    const auto reading = table_.read(time_, cells[time_], false);
    const double now = reading.value, load = value(load_, cells[load_]);
    const double angle = angle_ ? value(*angle_, cells[*angle_]) : 0;
    if (reading.kind == CellKind::hole) table_.problem(table_.here(time_), "the time is missing");
    if (reading.kind != CellKind::number) return;
    const bool again = !recording_.time.empty() && now == last_time_ && equal_times_ == EqualTimes::spread;
    if (!recording_.time.empty() && !(now > last_time_) && !again) {
      const double last = last_time_;
      table_.problem(
          table_.here(time_),
          "the time " + format_short(now, 10) + " s " +
              (now == last
                   ? "is in line " + std::to_string(recording_.line.back()) +
                         " too; write more of its digits, or spread such rows by equal_times=\"spread\""
                   : "runs backwards, after " + format_short(last, 10) + " s" + past_midnight(last - now)));
      return;
    }
    if (again) ++equal_rows_;
    last_time_ = now;
    recording_.time.push_back(now);
    recording_.load.push_back(load);
    if (angle_) recording_.angle.push_back(angle);
    recording_.line.push_back(static_cast<std::uint32_t>(table_.line()));
  }

  double value(std::size_t k, const TableCell& cell) { return table_.read(k, cell, false).value; }

  void spread_equal_times() {
    if (equal_rows_ == 0) return;
    Array<double>& time = recording_.time;
    for (std::size_t first = 0, end = 0; first < time.size(); first = end) {
      while (end < time.size() && time[end] == time[first]) ++end;
      const double begin = time[first];
      double spacing = 0;
      if (end < time.size())
        spacing = (time[end] - begin) / static_cast<double>(end - first);
      else if (first > 0)
        spacing = (begin - time.front()) / static_cast<double>(first);
      else
        refuse_file(file_, "has the same time in all of its rows");
      for (std::size_t k = first; k < end; ++k) time[k] = begin + static_cast<double>(k - first) * spacing;
    }
    monitor_.warn(file_name(file_.path()) + ": " + std::to_string(equal_rows_) +
                  " rows have the time of the row before them, and are spread evenly until the next time");
  }

  const SourceFile& file_;
  Monitor& monitor_;
  EqualTimes equal_times_;
  LogTable table_;
  PressRecording recording_;
  std::size_t time_ = 0, load_ = 0;
  std::optional<std::size_t> angle_;
  double last_time_ = 0;
  std::size_t equal_rows_ = 0;
};

}  // namespace

PressRecording read_press_recording(const SourceFile& file, Monitor& monitor, const TableForm& form,
                                    EqualTimes equal_times) {
  return RecordingReader(file, monitor, form, equal_times).read();
}

bool looks_like_recording(const SourceFile& file, const TableForm& form) {
  constexpr std::size_t many = 100;
  try {
    LogTable table(file, recording_columns, form);
    table.read_titles();
    // The reader reports unreadable units.
    if (!table.has(at_time) || table.has(of_dwell) || table.has(of_place) || table.has(of_turn)) return false;
    if (table.has(of_load) == table.has(of_pressure)) return false;
    const std::optional<std::size_t> angle = table.find(of_angle);
    const bool rotation = angle && table.column(*angle)->name == "rotation";
    std::size_t rows = 0;
    bool turns = false;
    table.read_rows(Monitor::silent(), [&](const std::vector<TableCell>& cells) {
      ++rows;
      turns = rotation && table.read(*angle, cells[*angle], false).value != 0;
      return !turns && (rotation || rows < many);
    });
    return !turns && rows >= many;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace asperity
