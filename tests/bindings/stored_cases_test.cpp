// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of cases as bytes, bit for bit; equality of functions.
#include "bindings/lua/ensemble/stored_cases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "bindings/lua/ensemble/transfer.hpp"
#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/runtime/code_digest.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "engine/core/error.hpp"

namespace asperity::lua::stored_cases_test {
namespace {

class Bench {
 public:
  Bench() : session_(Monitor::silent()), state_(make_state(session_, "")) {}
  lua_State* L() const { return state_.get(); }

  std::shared_ptr<const PackedValue> value(const std::string& chunk, Cargo cargo = Cargo::data) const {
    lua_settop(L(), 0);
    const std::string text = "local lab = require 'asperity' " + chunk;
    if (luaL_loadbufferx(L(), text.data(), text.size(), "=chunk", "t") != LUA_OK ||
        lua_pcall(L(), 0, 1, 0) != LUA_OK)
      throw Error(ErrorCode::bad_value, error_text(L(), -1));
    return pack(L(), -1, cargo, "run(case)", "");
  }
  bool holds(const std::shared_ptr<const PackedValue>& value, const std::string& condition) const {
    lua_settop(L(), 0);
    const std::string text = "local r = ... return " + condition;
    EXPECT_EQ(luaL_loadbufferx(L(), text.data(), text.size(), "=condition", "t"), LUA_OK);
    value->push(L());
    if (lua_pcall(L(), 1, 1, 0) != LUA_OK) {
      ADD_FAILURE() << error_text(L(), -1);
      return false;
    }
    return lua_toboolean(L(), -1) != 0;
  }

 private:
  Session session_;
  State state_;
};

std::shared_ptr<const PackedValue> again(const std::shared_ptr<const PackedValue>& value) {
  return PackedValue::from_bytes(value->bytes("run(case)"));
}

TEST(ParcelBytes, KeepNumbersToTheBit) {
  const Bench bench;
  const auto row = again(bench.value(
      "return { zero = -0.0, tiny = 5e-324, most = math.maxinteger, least = math.mininteger, up = math.huge, "
      "down = -math.huge, third = 1/3, whole = 3, float = 3.0, nan = 0/0, yes = true, no = false }"));
  EXPECT_TRUE(bench.holds(row, "1 / r.zero == -math.huge and r.tiny == 5e-324 and r.third == 1/3"));
  EXPECT_TRUE(bench.holds(row, "r.most == math.maxinteger and r.least == math.mininteger"));
  EXPECT_TRUE(bench.holds(row, "r.up == math.huge and r.down == -math.huge and r.nan ~= r.nan"));
  EXPECT_TRUE(bench.holds(row, "math.type(r.whole) == 'integer' and math.type(r.float) == 'float'"));
  EXPECT_TRUE(bench.holds(row, "r.yes == true and r.no == false"));
}

TEST(ParcelBytes, KeepHolesOfSurfacesAndProfiles) {
  const Bench bench;
  const std::string data = ASPERITY_TEST_DATA "/../data/";
  const auto row =
      bench.value("return { s = lab.surface.read('" + data + "fill_value.h5', { size = 1e-3 }), " +
                  "p = lab.profile.read('" + data + "profile_with_holes.csv') }");
  const auto found = again(row);
  EXPECT_EQ(found->digest(), row->digest());
  EXPECT_TRUE(bench.holds(found, "r.s:height(2, 0) ~= r.s:height(2, 0) and r.s:height(1, 0) == 2e-6"));
  EXPECT_TRUE(bench.holds(found, "r.p.points == 4 and r.p.spacing == 1e-06"));
}

TEST(ParcelBytes, KeepTextsOfAnyBytes) {
  const Bench bench;
  const auto row = again(bench.value(
      "return { zeros = 'a\\0b\\0', none = '', long = ('x'):rep(100000), bytes = '\\xff\\xfe' }"));
  EXPECT_TRUE(bench.holds(row, "r.zeros == 'a\\0b\\0' and r.none == '' and r.bytes == '\\xff\\xfe'"));
  EXPECT_TRUE(bench.holds(row, "r.long == ('x'):rep(100000)"));
}

TEST(ParcelBytes, KeepTablesThatAreShared) {
  const Bench bench;
  const auto row = again(bench.value(
      "local t = { 1, 2, n = { deep = {} } } t.self = t return { a = t, b = t, [3] = 'c', [true] = 1 }"));
  EXPECT_TRUE(
      bench.holds(row, "r.a == r.b and r.a.self == r.a and #r.a == 2 and r[3] == 'c' and r[true] == 1"));
  EXPECT_TRUE(bench.holds(again(bench.value("return {}")), "next(r) == nil"));
}

TEST(ParcelBytes, DigestIsTheSame) {
  const Bench bench;
  const auto row =
      bench.value("return { a = 1, b = { 2, 'x' }, m = lab.material{ young = 1, poisson = 0.3 } }");
  EXPECT_EQ(again(row)->digest(), row->digest());
}

TEST(ParcelBytes, KeepSurfacesProfilesAndResults) {
  const Bench bench;
  const auto row =
      again(bench.value("local s = lab.surface.from_table{ size = 1, heights = { {0, 1}, {2, 3.5} } } "
                        "return { s = s, p = s:profile{ row = 1 }, r = s:roughness(), h = s:heights() }"));
  EXPECT_TRUE(bench.holds(row, "r.s:height(1, 1) == 3.5"));
  EXPECT_TRUE(bench.holds(row, "r.r.Sa == r.s:roughness().Sa and r.h[2][2] == 3.5"));
  EXPECT_TRUE(bench.holds(row, "r.p:roughness().amplitude == 1.5"));
}

TEST(ParcelBytes, RefuseWhatTheyCannotCarryNamingIt) {
  const Bench bench;
  const auto refusal = [&](const std::string& chunk) -> std::string {
    try {
      (void)bench.value(chunk)->bytes("run(case)");
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::not_permitted);
      return error.what();
    }
    return "";
  };
  const std::string surface = "lab.surface.sine{ cells = 8, size = 1, amplitude = 0.1 }";
  EXPECT_EQ(refusal("return { list = { 1, " + surface + " } }")
                .find("`run(case).list[2]` holds a surface that its generator can make again on other cells, "
                      "which can neither be stored in a file nor sent to another process"),
            0U);
  EXPECT_NE(refusal("return { t = lab.stylus{ tip = '2 um', spacing = '1 um', length = '1 mm' } }")
                .find("`run(case).t` holds a stylus"),
            std::string::npos);
}

TEST(ParcelBytes, AnyDamageIsAnErrorOrAValue) {
  const Bench bench;
  const std::string bytes =
      bench.value("return { 1, 'x', { a = lab.material{ young = 1, poisson = 0.3 }, b = -0.0 } }")
          ->bytes("run(case)");
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_THROW((void)PackedValue::from_bytes(std::string_view(bytes).substr(0, length)), Error) << length;
  EXPECT_THROW((void)PackedValue::from_bytes(bytes + '\0'), Error);
  for (std::size_t k = 0; k < bytes.size(); ++k)
    for (const unsigned bit : {0U, 3U, 7U}) {
      std::string torn = bytes;
      torn[k] = static_cast<char>(static_cast<unsigned char>(torn[k]) ^ (1U << bit));
      try {
        (void)PackedValue::from_bytes(torn);
      } catch (const Error& error) {
        EXPECT_TRUE(error.code() == ErrorCode::bad_file || error.code() == ErrorCode::bad_value);
      }
    }
}

TEST(CaseBytes, KeepAllThatACaseFound) {
  const Bench bench;
  const auto surface = bench.value("return lab.surface.sine{ cells = 8, size = 1, amplitude = 0.1 }");
  const std::vector<CaseValue> given = {{"s", surface, "a surface"}};
  CaseResult result;
  result.digest = "d";
  result.output = std::string("a\0b\n", 4);
  result.warnings = {"first", "", "third"};
  result.inputs = {{"./file", 12, "abc", "file"}, {"gone", 0, "", ""}};
  result.drew = true;
  result.transforms = 1234.5;
  result.seconds = 0.1;
  lua_newtable(bench.L());
  surface->push(bench.L());
  lua_setfield(bench.L(), -2, "s");
  result.row = pack(bench.L(), -1, Cargo::data, "run(case)", "");
  const CaseResult found = case_from_bytes(case_bytes(result, given), given);
  EXPECT_EQ(found.digest, result.digest);
  EXPECT_EQ(found.output, result.output);
  EXPECT_EQ(found.warnings, result.warnings);
  ASSERT_EQ(found.inputs.size(), 2U);
  EXPECT_EQ(found.inputs[0].file, "./file");
  EXPECT_EQ(found.inputs[0].bytes, 12);
  EXPECT_EQ(found.inputs[0].beside_script, "file");
  EXPECT_EQ(found.inputs[1].digest, "");
  EXPECT_TRUE(found.drew);
  EXPECT_EQ(found.transforms, 1234.5);
  EXPECT_EQ(found.row->digest(), result.row->digest());
  EXPECT_TRUE(bench.holds(found.row, "r.s.cells ~= nil"));
}

TEST(CaseBytes, KeepAFailure) {
  CaseResult result;
  result.failure = "script.lua:3: no\nstack traceback:\n";
  const CaseResult found = case_from_bytes(case_bytes(result, {}), {});
  EXPECT_EQ(found.row, nullptr);
  EXPECT_EQ(found.failure, result.failure);
}

// Later versions replay digests in journals.
TEST(PackedValueDigest, IsThatOfEarlierJournals) {
  const Bench bench;
  Record record;
  record.name = "roughness";
  record.add("Ra", 1e-6, dimension::length).add("parts", List({1, "two"})).add("by", Map{{{"x", 1.5}}});
  push(bench.L(), Value(record));
  lua_setglobal(bench.L(), "record");
  const auto row = bench.value(
      "local shared = { 1, 'one' } "
      "local s = lab.surface.from_table{ size = 1, heights = { { 0, 1 }, { 2, 3 } } } "
      "return { 3, 2.5, 'three', true, [1.5] = -0.0, a = shared, b = shared, c = { { x = 1 }, { y = false } "
      "}, "
      "d = lab.material{ young = 1e9, poisson = 0.25 }, e = s, f = s:heights(), g = record }");
  EXPECT_EQ(row->digest(), "5eadff9513fe5d6b7f12b6c2e40c07ee");
  EXPECT_EQ(again(row)->digest(), row->digest());
}

TEST(ParcelContent, KnowsWhatAFunctionDoesAndNotWhereItStands) {
  const Bench a, b;
  const auto digest = [](const Bench& bench, const std::string& chunk) {
    return bench.value(chunk, Cargo::functions)->content().digest;
  };
  const std::string code =
      "local n, t = 3, { x = 1, y = { 2 } } return function(c) return { z = c.k * n + t.x } end";
  EXPECT_EQ(digest(a, code), digest(b, code));
  EXPECT_EQ(digest(a, "\n\n-- a remark\n" + code), digest(a, code));
  EXPECT_NE(a.value("\n" + code, Cargo::functions)->content().lines,
            a.value(code, Cargo::functions)->content().lines);
  for (const auto& [from, to] : {std::pair("n, t = 3", "n, t = 4"), std::pair("y = { 2 }", "y = { 2.0 }"),
                                 std::pair("c.k * n", "c.k + n"), std::pair("z =", "w =")}) {
    std::string other = code;
    other.replace(other.find(from), std::string(from).size(), to);
    EXPECT_NE(digest(a, other), digest(a, code)) << to;
  }
}

// The spelling of the script's path must not change digests.
TEST(ParcelContent, IsTheSameHoweverTheScriptIsNamed) {
  struct Typed {
    ScriptSpelling script;
    std::string file;  // as Lua names it
  };
  const std::vector<Typed> typed = {{{"ens.lua", "."}, "@ens.lua"},
                                    {{"./ens.lua", "."}, "@./ens.lua"},
                                    {{"/home/me/ens.lua", "/home/me"}, "@/home/me/ens.lua"},
                                    {{"../me/copy.lua", "../me"}, "@../me/copy.lua"}};
  const auto content = [](const Typed& as, const std::string& body) {
    Session session(Monitor::silent());
    session.script = as.script;
    const State state = make_state(session, as.script.folder);
    lua_State* L = state.get();
    const std::string text = "arg = { [0] = '" + as.script.path + "', 'one' } " + body;
    if (luaL_loadbufferx(L, text.data(), text.size(), as.file.c_str(), "t") != LUA_OK ||
        lua_pcall(L, 0, 1, 0) != LUA_OK)
      throw Error(ErrorCode::bad_value, error_text(L, -1));
    return pack(L, -1, Cargo::functions, "run", "")->content(session.script);
  };
  const std::string plain = "return function(case) return { y = 2 * case.k } end";
  const PackedValue::Content first = content(typed[0], plain);
  for (const Typed& other : typed) {
    EXPECT_EQ(content(other, plain).digest, first.digest) << other.script.path;
    EXPECT_EQ(content(other, plain).lines, first.lines) << other.script.path;
  }
  EXPECT_NE(content(typed[0], "\n" + plain).lines, first.lines);
  // These functions read the script's name or search path.
  for (const char* body :
       {"return function() return { y = arg[0] } end", "local a = arg return function() return a end",
        "package.path = package.path .. ';x/?.lua' return function() return {} end"})
    EXPECT_NE(content(typed[0], body).digest, content(typed[2], body).digest) << body;
}

TEST(ParcelContent, SaysWhereADigestIsNotTheWhole) {
  const Bench bench;
  const auto whole = [&](const std::string& chunk) {
    return bench.value(chunk, Cargo::functions)->content().whole;
  };
  EXPECT_TRUE(whole("local m = lab.material{ young = 1, poisson = 0.3 } return function() return m end"));
  EXPECT_TRUE(whole("local open, atan = io.open, math.atan return function() return open, atan, lab end"));
  EXPECT_FALSE(
      whole("local s = lab.surface.sine{ cells = 8, size = 1, amplitude = 0.1 } "
            "return function() return s end"));
}

TEST(CodeDigest, TakesWhatItDoesNotUnderstandAsItIs) {
  EXPECT_NE(code_digest("not a dump"), code_digest("not a dumb"));
  EXPECT_EQ(code_digest(""), code_digest(""));
}

}  // namespace
}  // namespace asperity::lua::stored_cases_test
