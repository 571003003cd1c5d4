// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/api/access.hpp"

#include <gtest/gtest.h>

#include <set>

namespace asperity::web::access_test {
namespace {

HttpRequest request(std::multimap<std::string, std::string> headers, std::string path = "/api/about") {
  HttpRequest made;
  made.method = "GET";
  made.path = std::move(path);
  made.headers = std::move(headers);
  return made;
}

const Access two({"127.0.0.1:8137", "localhost:8137"}, {{"Ada", "abcd"}, {"Émilie", "abce"}});

TEST(Access, KnowsEachPersonByTheWholeToken) {
  EXPECT_EQ(two.person(request({{"authorization", "Bearer abcd"}})), 0U);
  EXPECT_EQ(two.person(request({{"authorization", "Bearer abce"}})), 1U);
  for (const char* wrong :
       {"Bearer abc", "Bearer abcde", "Bearer abcf", "Bearer ", "bearer abcd", "abcd", ""})
    EXPECT_FALSE(two.person(request({{"authorization", wrong}}))) << wrong;
  EXPECT_FALSE(two.person(request({})));
  EXPECT_FALSE(two.person(request({{"authorization", "Bearer abcd"}, {"authorization", "Bearer abcd"}})));
}

TEST(Access, AnswersToItsOwnNamesOnly) {
  EXPECT_EQ(two.misdirected(request({{"host", "localhost:8137"}})), "");
  for (const char* other :
       {"evil.example", "127.0.0.1", "127.0.0.1:81377", "127.0.0.1:8137 ", "", "LOCALHOST:8138"})
    EXPECT_EQ(two.misdirected(request({{"host", other}})), "this server is not the one that Host names")
        << other;
  EXPECT_NE(two.misdirected(request({})), "");
  EXPECT_NE(two.misdirected(request({{"host", "localhost:8137"}, {"host", "localhost:8137"}})), "");
}

TEST(Access, TakesNothingFromAPageOfAnotherOrigin) {
  const auto from = [](const char* origin) {
    return two.misdirected(request({{"host", "localhost:8137"}, {"origin", origin}}));
  };
  EXPECT_EQ(from("http://localhost:8137"), "");
  for (const char* other :
       {"null", "http://localhost", "https://localhost:8137", "http://localhost:8137.evil.example"})
    EXPECT_NE(from(other), "") << other;
}

TEST(Access, LetsALinkLeadToThePageAndNotToTheInterface) {
  const std::multimap<std::string, std::string> link{
      {"host", "localhost:8137"}, {"sec-fetch-site", "cross-site"}, {"sec-fetch-mode", "navigate"}};
  EXPECT_EQ(two.misdirected(request(link, "/")), "");
  EXPECT_NE(two.misdirected(request(link, "/api/about")), "");
}

TEST(NewToken, IsNeverTheSame) {
  std::set<std::string> tokens;
  for (int k = 0; k < 1000; ++k) tokens.insert(new_token());
  EXPECT_EQ(tokens.size(), 1000U);
  for (const std::string& token : tokens) ASSERT_EQ(token.size(), 43U);
}

TEST(SameText, IsSameLengthAndEveryByte) {
  EXPECT_TRUE(same_text("", ""));
  EXPECT_TRUE(same_text("abc", "abc"));
  EXPECT_FALSE(same_text("abc", "abcd"));
  EXPECT_FALSE(same_text("abc", "abd"));
  EXPECT_FALSE(same_text("\xFF", "\x7F"));
}

}  // namespace
}  // namespace asperity::web::access_test
