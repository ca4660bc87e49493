// SPDX-License-Identifier: Apache-2.0
#include "web/http.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace navcal::web {
namespace {

TEST(Http, PathEndsAtTheQuery) {
  EXPECT_EQ(path_of("/a/b?c=d"), "/a/b");
  EXPECT_EQ(path_of("/a#b"), "/a");
  EXPECT_EQ(path_of(""), "");
}

TEST(Http, QueryValuesAreDecoded) {
  EXPECT_EQ(query_value("/s?subscribe=self&x=a%20b+c", "x"), "a b c");
  EXPECT_EQ(query_value("/s?subscribe=self", "subscribe"), "self");
  EXPECT_EQ(query_value("/s?sub=1", "subscribe"), "");
  EXPECT_EQ(query_value("/s", "x"), "");
  EXPECT_EQ(query_value("/s?x", "x"), "");
  EXPECT_EQ(query_value("/s?x=%4", "x"), "%4");
  EXPECT_EQ(query_value("/s?x=%zz%41", "x"), "%zzA");
}

TEST(Http, RefusalIsJsonWhateverItSays) {
  const Response response = refuse(boost::beast::http::status::not_found, "there is no /\"\xff\n");
  const auto answer = nlohmann::json::parse(response.body());
  EXPECT_FALSE(answer["ok"].get<bool>());
  EXPECT_EQ(response.result_int(), 404U);
}

}  // namespace
}  // namespace navcal::web
