// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <set>

namespace asperity {

StaticText::StaticText(const std::string& composed) {
  static std::mutex mutex;
  static auto& all = *new std::set<std::string>;  // never destroyed: static tables of other sources use it
  const std::lock_guard lock(mutex);
  *this = all.insert(composed).first->c_str();
}

std::string format_exact(double value) {
  if (std::isnan(value)) return "nan";
  std::array<char, 40> buffer{};
  auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return error == std::errc{} ? std::string(buffer.data(), end) : std::string("nan");
}

std::string format_short(double value, int digits) {
  if (std::isnan(value)) return "nan";
  std::array<char, 40> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*g", digits, value);
  return buffer.data();
}

std::string format_bytes(std::int64_t bytes) {
  constexpr std::array units = {"B", "KiB", "MiB", "GiB", "TiB"};
  auto value = static_cast<double>(bytes);
  std::size_t unit = 0;
  while (value >= 1024 && unit + 1 < units.size()) {
    value /= 1024;
    ++unit;
  }
  return format_short(value, 4) + " " + units[unit];
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::string hexadecimal(std::span<const unsigned char> bytes) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : bytes) {
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text;
}

std::string quoted(std::string_view name) { return "`" + std::string(name) + "`"; }

std::string safe_file_name(std::string_view text) {
  constexpr std::size_t longest = 120;
  std::string name;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool kept = std::isalnum(byte) || c == '_' || c == '.' || byte >= 0x80;
    if (kept) {
      name += c;
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  if (name.size() > longest) {
    name.resize(longest);
    name.resize(longest - unfinished_bytes(name));
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  const std::size_t first = name.find_first_not_of(".-");
  name.erase(0, first == std::string::npos ? name.size() : first);
  return name.empty() ? "unnamed" : name;
}

std::string counted(std::size_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

std::string joined(std::span<const std::string> items, std::string_view last) {
  std::string text;
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (k > 0) text += k + 1 == items.size() ? std::string(last) : std::string(", ");
    text += items[k];
  }
  return text;
}

std::size_t utf8_bytes(std::string_view text) {
  const auto byte = [&](std::size_t k) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(text[k]));
  };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return 0;
  std::uint32_t point = lead & (0x7FU >> bytes);
  for (std::size_t k = 1; k < bytes; ++k) {
    if ((byte(k) & 0xC0) != 0x80) return 0;
    point = point << 6 | (byte(k) & 0x3F);
  }
  // Overlong forms, surrogates, beyond the last code point.
  const bool wrong = (bytes == 3 && point < 0x800) || (bytes == 4 && point < 0x10000) || point > 0x10FFFF ||
                     (point >= 0xD800 && point < 0xE000);
  return wrong ? 0 : bytes;
}

std::size_t characters_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string aligned(const std::vector<TextLine>& lines, bool right) {
  std::vector<std::size_t> widths;
  for (const TextLine& line : lines) {
    widths.resize(std::max(widths.size(), line.size()));
    for (std::size_t c = 0; c < line.size(); ++c) widths[c] = std::max(widths[c], characters_of(line[c]));
  }
  std::string text;
  for (const TextLine& line : lines) {
    std::string row;
    for (std::size_t c = 0; c < line.size(); ++c) {
      const std::string padding(widths[c] - characters_of(line[c]), ' ');
      row += "  " + (right && c > 0 ? padding + line[c] : line[c] + padding);
    }
    text += "\n" + row.substr(0, row.find_last_not_of(' ') + 1);
  }
  return text;
}

std::string plain_text(std::string text) {
  for (std::size_t k = 0; k < text.size();) {
    std::size_t bytes = utf8_bytes(std::string_view(text).substr(k));
    const auto lead = static_cast<unsigned char>(text[k]);
    const bool control = lead == 0x7F || (lead < 0x20 && lead != '\n' && lead != '\t') ||
                         (bytes == 2 && lead == 0xC2 && static_cast<unsigned char>(text[k + 1]) < 0xA0);
    if (control) bytes = 0;
    if (bytes == 0) text[k] = '?';
    k += std::max<std::size_t>(bytes, 1);
  }
  return text;
}

std::string shown(std::string_view text, std::size_t longest) {
  std::string_view head = text.substr(0, longest);
  if (text.size() > longest) head.remove_suffix(unfinished_bytes(head));
  std::string result = plain_text(std::string(head));
  for (char& c : result)
    if (c == '\n' || c == '\t') c = '?';
  return "\"" + result + (text.size() > longest ? "...\"" : "\"");
}

namespace {

// Optimal string alignment distance.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  const std::size_t columns = b.size() + 1;
  std::vector<std::size_t> before(columns), previous(columns), current(columns);
  for (std::size_t j = 0; j < columns; ++j) previous[j] = j;
  auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j < columns; ++j) {
      const std::size_t cost = lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1;
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, previous[j - 1] + cost});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        current[j] = std::min(current[j], before[j - 2] + 1);
    }
    std::swap(before, previous);
    std::swap(previous, current);
  }
  return previous[b.size()];
}

}  // namespace

std::string nearest_name(std::string_view name, std::span<const std::string> candidates) {
  constexpr std::size_t longest = 64;
  if (name.empty() || name.size() > longest) return {};
  std::string best;
  std::size_t best_distance = 1 + name.size() / 3;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > longest) continue;
    std::size_t distance = edit_distance(name, candidate);
    // A prefix is near: "mat" for "material".
    if (name.size() >= 3 && candidate.size() > name.size() && candidate.starts_with(name))
      distance = std::min<std::size_t>(distance, 1);
    if (distance < best_distance || (distance == best_distance && best.empty())) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view name, std::span<const std::string> candidates) {
  const std::string near = nearest_name(name, candidates);
  return near.empty() ? std::string() : " (did you mean " + quoted(near) + "?)";
}

std::string without_traceback(const std::string& message) {
  return message.substr(0, message.find("\nstack traceback:"));
}

std::size_t unfinished_bytes(std::string_view text) {
  for (std::size_t back = 1; back <= std::min<std::size_t>(3, text.size()); ++back) {
    const auto byte = static_cast<unsigned char>(text[text.size() - back]);
    if ((byte & 0xC0) == 0x80) continue;
    const std::size_t length = byte >= 0xF0 ? 4 : byte >= 0xE0 ? 3 : byte >= 0xC0 ? 2 : 1;
    return length > back ? back : 0;
  }
  return 0;
}

std::optional<std::uint64_t> count_in(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

}  // namespace asperity
