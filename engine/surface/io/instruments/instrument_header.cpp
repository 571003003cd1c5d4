// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/io/instruments/instrument_header.hpp"

#include <charconv>
#include <cmath>
#include <set>

#include "engine/surface/io/column_head.hpp"

namespace asperity {

namespace {

std::string listed_names(const std::vector<NamedMap>& maps, bool only_heights) {
  std::vector<std::string> names;
  for (const NamedMap& map : maps)
    if (map.heights || !only_heights) names.push_back(quoted(map.name));
  return listed_up_to(24, std::move(names));
}

// Returns NaN without a number.
double leading_number(std::string_view text, std::string_view& rest) {
  double value = 0;
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc()) return std::nan("");
  rest = trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
  return value;
}

}  // namespace

std::uint64_t instrument_count(const SourceFile& file, std::string_view key, std::string_view text) {
  if (const auto count = count_in(trimmed(text))) return *count;
  refuse_file(file, "has no count for " + quoted(key) + " in its header: " + shown(trimmed(text)));
}

double instrument_number(const SourceFile& file, std::string_view key, std::string_view text) {
  std::string_view rest;
  const double value = leading_number(trimmed(text), rest);
  if (!std::isfinite(value) || !rest.empty())
    refuse_file(file, "has no number for " + quoted(key) + " in its header: " + shown(text));
  return value;
}

std::optional<double> instrument_length_unit(std::string_view text) {
  text = trimmed(text);
  // "A" is ampere here; "1,5 nm" is no unit.
  if (text == "A" || text.find(' ') != std::string_view::npos) return {};
  if (text == "~m" || text == "\xB5m" || text == "\xC2\xB5m" || text == "\xCE\xBCm") return 1e-6;
  if (text == "\xC5" || text == "\xC3\x85") return 1e-10;
  return length_unit(text);
}

double instrument_length(const SourceFile& file, std::string_view key, std::string_view text) {
  std::string_view unit;
  const double value = leading_number(trimmed(text), unit);
  const std::optional<double> metres = unit.empty() ? std::nullopt : instrument_length_unit(unit);
  if (!(value > 0) || !std::isfinite(value) || !metres)
    refuse_file(file, "has no length for " + quoted(key) + " in its header: " + shown(text));
  return value * *metres;
}

std::optional<std::string_view> HeaderEntries::find(std::string_view key) const {
  const auto found = entries_.find(key);
  return found == entries_.end() ? std::nullopt : std::optional<std::string_view>(found->second);
}

std::string_view HeaderEntries::text(std::string_view key) const {
  if (const auto found = find(key)) return *found;
  refuse_file(*file_, "has no " + quoted(key) + " in its header");
}

std::uint64_t HeaderEntries::count(std::string_view key) const {
  return instrument_count(*file_, key, text(key));
}

double HeaderEntries::number(std::string_view key) const { return instrument_number(*file_, key, text(key)); }

double HeaderEntries::decimal(std::string_view key) const {
  const TextCell cell = read_cell(trimmed(text(key)), Separator::blank);
  if (cell.kind != CellKind::number && cell.kind != CellKind::hole)
    refuse_file(*file_, "has no number for " + quoted(key) + " in its header: " + shown(text(key)));
  return cell.value;
}

double HeaderEntries::length(std::string_view key, std::string_view unit) const {
  return instrument_length(*file_, key, trimmed(std::string(text(key)) + " " + std::string(unit)));
}

void tell_apart(std::vector<NamedMap>& maps) {
  std::set<std::string> taken;
  std::map<std::string, std::size_t> last_number;
  for (NamedMap& map : maps) {
    const std::string plain = map.name;
    std::size_t& last = last_number.try_emplace(plain, 1).first->second;
    while (!taken.insert(map.name).second) map.name = plain + " (" + std::to_string(++last) + ")";
  }
}

void tell_apart_by(std::vector<NamedMap>& maps, const std::vector<std::string>& more) {
  std::map<std::string, std::size_t> met;
  for (const NamedMap& map : maps) ++met[map.name];
  for (std::size_t k = 0; k < maps.size(); ++k)
    if (met[maps[k].name] > 1) maps[k].name += more[k];
  tell_apart(maps);
}

std::size_t chosen_map(const SourceFile& file, const std::vector<NamedMap>& maps,
                       const std::string& channel) {
  if (maps.empty()) refuse_file(file, "holds no map");
  if (!channel.empty()) {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < maps.size(); ++k) {
      if (maps[k].name == channel) return k;
      names.push_back(maps[k].name);
    }
    refuse_file(file,
                "holds no map " + quoted(channel) + did_you_mean(channel, names) + " but " +
                    listed_names(maps, false),
                "name one of them with `channel`");
  }
  std::size_t found = maps.size(), count = 0;
  for (std::size_t k = maps.size(); k-- > 0;)
    if (maps[k].heights) {
      found = k;
      ++count;
    }
  if (count == 0)
    refuse_file(file, "holds no map of heights but " + listed_names(maps, false),
                "name one of them with `channel` if it is in a unit of length");
  if (count > 1)
    refuse_file(file, "holds several maps of heights: " + listed_names(maps, true),
                "name one of them with `channel`");
  return found;
}

void refuse_no_heights(const SourceFile& file, const NamedMap& map, const std::string& unit) {
  refuse_file(file, "holds the map " + quoted(map.name) + " in " + unit + ", which is no unit of length",
              "name a map of heights with `channel`");
}

}  // namespace asperity
