#include "api/json/json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "tests/api/support.h"

namespace plenum::api {
namespace json_test {

using std::string_literals::operator""s;

bool IsGood(std::string_view text) { return std::holds_alternative<Json>(ParseJson(text)); }

Error ErrorOf(std::string_view text) {
  const Errors errors = ErrorsOf(ParseJson(text));
  return errors.empty() ? Error{"none", "none"} : errors.front();
}

// Bodies in the manner of the JSON parsing test suite (n_*: must be refused).
TEST(ParseJson, RefusesWhatIsNotJson) {
  for (const std::string& text : {
           ""s,
           " "s,
           "{"s,
           "["s,
           "]"s,
           "{]"s,
           "[1,]"s,
           "[1,,2]"s,
           "[,1]"s,
           "{\"a\":1,}"s,
           "{\"a\" 1}"s,
           "{a:1}"s,
           "{'a':1}"s,
           "{1:1}"s,
           "[1 2]"s,
           "[NaN]"s,
           "[Infinity]"s,
           "[-Infinity]"s,
           "[nan]"s,
           "nul"s,
           "[tru]"s,
           "True"s,
           "[01]"s,
           "[-01]"s,
           "[+1]"s,
           "[.5]"s,
           "[1.]"s,
           "[1e]"s,
           "[1e+]"s,
           "[0x1]"s,
           "[1_000]"s,
           "[-]"s,
           "[\"\x01\"]"s,
           "[\"\t\"]"s,
           "[\"\\x00\"]"s,
           "[\"\\u00\"]"s,
           "[\"\\uD800\"]"s,
           "[\"a]"s,
           "[\"\xff\"]"s,          // not UTF-8
           "[\"\xc3\"]"s,          // cut character
           "[\"\xed\xa0\x80\"]"s,  // surrogate in UTF-8
           "[\"\xc0\xaf\"]"s,      // overlong
           "// c\n1"s,
           "/* c */ 1"s,
           "{} {}"s,
           "{}x"s,
           "1 2"s,
           "{}\0"s,
           "{}\0{\"a\":"s,
           "[\0]"s,
       })
    EXPECT_FALSE(IsGood(text)) << text;
}

TEST(ParseJson, AcceptsWhatIsJson) {
  for (const std::string& text :
       {"0"s, "-0"s, "null"s, "\"\""s, "[]"s, "{}"s, " [1 , 2.5e-3,\ttrue]\r\n"s,
        "{\"a\":{\"a\":[{\"a\":1}]},\"b\":1}"s, "[\"\\u0000\\uD834\\uDD1E\"]"s, "[\"\xc3\xa9\"]"s,
        "[9007199254740993]"s, "[18446744073709551615]"s, "[-9223372036854775808]"s, "[1E400e]"s})
    EXPECT_EQ(IsGood(text), text != "[1E400e]") << text;
}

TEST(ParseJson, KeepsValuesAndTheOrderOfFields) {
  const Json json = Parse(R"({"b": [1, -2, 0.5, "x", null, true], "a": {}})");
  EXPECT_EQ(json.dump(), R"({"b":[1,-2,0.5,"x",null,true],"a":{}})");
  EXPECT_EQ(Parse("[18446744073709551615]")[0].get<std::uint64_t>(), 18446744073709551615u);
}

TEST(ParseJson, LimitsDepthWhileReading) {
  EXPECT_TRUE(IsGood(std::string(64, '[') + std::string(64, ']')));
  EXPECT_FALSE(IsGood(std::string(65, '[') + std::string(65, ']')));
  EXPECT_NE(ErrorOf(std::string(1'000'000, '[')).detail.find("deeper than 64"), std::string::npos);
  std::string objects;
  for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
  EXPECT_NE(ErrorOf(objects).detail.find("deeper than 64"), std::string::npos);
}

TEST(ParseJson, NamesTheFieldThatAppearsTwice) {
  EXPECT_EQ(ErrorOf(R"({"a":[{"x":1},{"y":1,"z":2,"y":3}]})"),
            (Error{"/a/1/y", "field \"y\" appears twice"}));
  EXPECT_EQ(ErrorOf(R"({"a/b":1,"a/b":1})").pointer, "/a~1b");
  // The same after unescaping.
  EXPECT_FALSE(IsGood(R"({"a":1,"\u0061":2})"));
}

TEST(ParseJson, NamesTheNumberThatDoesNotFit) {
  EXPECT_NE(ErrorOf("[1e400]").detail.find("overflow"), std::string::npos);
  EXPECT_FALSE(IsGood("[" + std::string(10'000, '9') + "]"));
}

// JavaScript writes numbers below 1e21 without an exponent.
TEST(ParseJson, AnIntegerPast64BitsIsTheNearestNumber) {
  for (const auto& [text, value] : {std::pair{"18446744073709551616", 0x1p64},
                                    {"-9223372036854775809", -0x1p63},
                                    {"307000000000000000000", 3.07e20}}) {
    const auto parsed = ParseJson(text);
    ASSERT_TRUE(std::holds_alternative<Json>(parsed)) << text;
    EXPECT_EQ(std::get<Json>(parsed).get<double>(), value);
  }
}

TEST(ParseJson, SaysWhereTheTextBreaks) {
  EXPECT_NE(ErrorOf("{\n  \"a\": ?\n}").detail.find("line 2, column 8"), std::string::npos)
      << ErrorOf("{\n  \"a\": ?\n}").detail;
  // The message can itself be written as JSON even if the text was not UTF-8.
  for (const char* text : {"[\"\xff\xfe\"]", "\xff", "{\"\xc3\": 1}"})
    EXPECT_NO_THROW(Json(ErrorOf(text).detail).dump()) << text;
}

TEST(Number, RoundsToTwelveDigitsAndHasNoInfinity) {
  EXPECT_EQ(Number(0.1 + 0.2).dump(), "0.3");
  EXPECT_EQ(Number(1.0 / 3.0).dump(), "0.333333333333");
  EXPECT_EQ(Number(-0.0).dump(), "0.0");
  EXPECT_EQ(Number(123456789012.5).dump(), "123456789012.0");  // to even
  EXPECT_TRUE(Number(std::numeric_limits<double>::infinity()).is_null());
  EXPECT_TRUE(Number(std::nan("")).is_null());
}

}  // namespace json_test
}  // namespace plenum::api
