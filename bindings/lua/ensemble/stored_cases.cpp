// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/ensemble/stored_cases.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "bindings/lua/ensemble/byte_fields.hpp"
#include "bindings/lua/registry/dry_run.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/program_identity.hpp"
#include "engine/core/text.hpp"
#include "engine/run/ranks.hpp"

namespace asperity::lua {

namespace {

constexpr std::string_view case_form = "asperity case 4";
constexpr std::size_t most_bytes_of_many = 16384;
// Uses of random numbers, and of knobs.
constexpr std::array<std::pair<bool, bool>, 4> ways = {
    {{false, false}, {true, false}, {false, true}, {true, true}}};
constexpr std::size_t bytes_a_number = 6;  // exact in a double

Field packed(std::string_view bytes) {
  const std::size_t numbers = (bytes.size() + bytes_a_number - 1) / bytes_a_number;
  Field field(static_cast<int>(std::max<std::size_t>(numbers, 1)), 1);
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    constexpr std::array<double, bytes_a_number> place = {1.0, 0x1p8, 0x1p16, 0x1p24, 0x1p32, 0x1p40};
    field[k / bytes_a_number] += place[k % bytes_a_number] * static_cast<unsigned char>(bytes[k]);
  }
  return field;
}

std::string unpacked(const Field& field, double length) {
  if (!(length >= 0 && length <= static_cast<double>(field.size() * bytes_a_number))) ByteReader::damaged();
  std::string bytes(static_cast<std::size_t>(length), '\0');
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    const double value = field[k / bytes_a_number];
    if (!(value >= 0 && value < 0x1p48)) ByteReader::damaged();
    bytes[k] = static_cast<char>((static_cast<std::uint64_t>(value) >> (8 * (k % bytes_a_number))) & 0xffU);
  }
  return bytes;
}

std::vector<Value> natives(const std::vector<CaseValue>& values) {
  std::vector<Value> given;
  for (const CaseValue& value : values)
    given.push_back(value.value->native() != nullptr ? *value.value->native() : Value());
  return given;
}

}  // namespace

std::string case_bytes(const CaseResult& result, const std::vector<CaseValue>& given) {
  ByteWriter out;
  out.text(case_form);
  out.number(result.row != nullptr);
  if (result.row != nullptr) out.text(result.row->bytes("run(case)", natives(given)));
  write_fields(out, result);
  return out.take();
}

CaseResult case_from_bytes(std::string_view bytes, const std::vector<CaseValue>& given) {
  ByteReader in(bytes);
  if (in.text() != case_form) ByteReader::damaged();
  CaseResult result;
  if (in.truth()) result.row = PackedValue::from_bytes(in.text(), natives(given));
  read_fields(in, result);
  if (!in.at_end()) ByteReader::damaged();
  return result;
}

ResultStore* results_for_cases(const Session& session) {
  return session.ranks != nullptr ? session.ranks->own_store : session.monitor().results();
}

StoredCases::StoredCases(const Session& session, const PackedValue& run) {
  if (session.dry_run) return;
  if (session.trusted || session.refinement != nullptr || session.variation != nullptr) return;
  store_ = results_for_cases(session);
  if (store_ == nullptr) return;
  content_ = run.content(session.script);
  folder_ = session.script.folder;
  if (!content_.whole) script_ = session.script_digest + " " + std::to_string(session.ensembles);
}

std::string StoredCases::key_of(const CaseSetup& setup, bool drew, bool asked) const {
  Digester digester;
  // C libraries with other rounding share no cases.
  digester.add(case_form).add(c_library_functions()).add(content_.digest).add(setup.depth);
  digester.add(static_cast<std::int64_t>(setup.values.size()));
  bool whole = content_.whole;
  for (const CaseValue& value : setup.values) {
    const PackedValue::Content content = value.value->content();
    whole = whole && content.whole;
    digester.add(value.key).add(content.digest);
  }
  // Script and place replace a missing digest.
  if (!whole)
    digester.add(script_.empty() ? setup.script_digest + " " + std::to_string(setup.ensemble) : script_);
  if (drew) digester.add(static_cast<std::int64_t>(setup.seed));
  if (asked) digester.add("knobs").add(setup.knobs->given_text());
  return "case " + digester.hex();
}

std::vector<std::string> StoredCases::keys(const CaseSetup& setup) const {
  std::vector<std::string> keys;
  for (const auto& [drew, asked] : ways) keys.push_back(key_of(setup, drew, asked));
  return keys;
}

std::optional<CaseResult> StoredCases::find(const CaseSetup& setup, bool with_failures) const {
  if (store_ == nullptr) return {};
  for (const auto& [drew, asked] : ways)
    if (auto found = find_under(key_of(setup, drew, asked), setup); found && found->failure.empty())
      return found;
  if (!with_failures) return {};
  for (const auto& [drew, asked] : ways)
    if (auto found = find_under(std::string(failed_case) + key_of(setup, drew, asked), setup)) return found;
  return {};
}

std::optional<CaseResult> StoredCases::find_under(const std::string& key, const CaseSetup& setup) const {
  try {
    std::optional<FoundResult> found = store_->find(key);
    if (!found) return {};
    const std::string bytes = unpacked(found->take("case"), found->number("bytes"));
    CaseResult result = case_from_bytes(bytes, setup.values);
    if (found->text("names lines") == "yes" && found->text("lines") != content_.lines) return {};
    for (CaseInput& input : result.inputs)
      if (!input.beside_script.empty()) input.file = folder_ + "/" + input.beside_script;
    const bool same = std::ranges::all_of(result.inputs, [&](const CaseInput& input) {
      const LoadedFile* copy = input.loaded ? recorded_copy(setup.loaded, input.file) : nullptr;
      return (copy != nullptr ? copy->digest : present_digest(input.file)) == input.digest;
    });
    if (same) return result;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::bad_file && error.code() != ErrorCode::internal) throw;
  }
  return {};
}

void StoredCases::keep(const CaseSetup& setup, const CaseResult& result, bool always) const {
  if (store_ == nullptr || (result.row == nullptr && !always)) return;
  std::string bytes;
  try {
    bytes = case_bytes(result, setup.values);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::not_permitted || always) throw;
    return;  // stored heavy calls suffice
  }
  ResultFacts facts;
  facts.cost.seconds = result.seconds;
  facts.cost.transforms = result.transforms;
  facts.however_cheap = always;
  facts.one_of_many = bytes.size() <= most_bytes_of_many;
  facts.numbers = {{"bytes", static_cast<double>(bytes.size())}};
  facts.texts = {{"lines", content_.lines}, {"names lines", line_of(bytes) != "?" ? "yes" : "no"}};
  const Field field = packed(bytes);
  std::string key = key_of(setup, result.drew, !result.knobs.empty());
  if (result.row == nullptr) {
    key.insert(0, failed_case);
    facts.texts.emplace_back("failure", without_traceback(result.failure));
  }
  store_->keep(key, "lab.ensemble", facts, {{"case", &field}});
}

}  // namespace asperity::lua
