#include "api/json/reader.h"

#include <gtest/gtest.h>

#include <cmath>

#include "api/json/words.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace reader_test {

struct Read {
  Json json;
  Errors errors;
  Reader reader;
  explicit Read(const char* text) : json(Parse(text)), reader(json, "/here", errors) {}
  std::string Detail(const char* pointer) const { return DetailAt(errors, pointer); }
};

TEST(Reader, GivesValuesWithinTheirRange) {
  Read in(R"({"x": 2.5, "n": 3.0, "b": false, "t": "é", "c": "red", "z": null, "l": [1, 2]})");
  EXPECT_EQ(in.reader.Number("x", {0, 2.5}), 2.5);
  EXPECT_EQ(in.reader.Integer("n", 1, 3), 3);
  EXPECT_FALSE(in.reader.Bool("b", true));
  EXPECT_EQ(in.reader.Text("t"), "é");
  EXPECT_EQ(in.reader.Choice("c", {"blue", "red"}), "red");
  EXPECT_EQ(in.reader.OptionalNumber("z", {0, 1}), std::nullopt);
  EXPECT_EQ(in.reader.Numbers("l", 5, {0, 9}), (std::vector<double>{1, 2}));
  EXPECT_EQ(in.reader.Numbers("x", 5, {0, 9}), (std::vector<double>{2.5}));
  EXPECT_EQ(in.reader.Number("missing", {0, 1}, 0.5), 0.5);
  EXPECT_EQ(in.reader.OptionalNumber("missing", {0, 1}), std::nullopt);
  in.reader.Finish();
  EXPECT_TRUE(in.errors.empty());
}

TEST(Reader, NamesValueAndRange) {
  Read in(R"({"x": -3, "y": 0, "z": 1, "n": 2.5, "t": 7, "c": "green", "b": 1, "s": ""})");
  EXPECT_TRUE(std::isnan(in.reader.Number("x", {0.01, 1e6})));
  EXPECT_EQ(in.Detail("/here/x"), "must be ≥ 0.01 and ≤ 1e6, not -3");
  in.reader.Number("y", Above(0, 1e6));
  EXPECT_EQ(in.Detail("/here/y"), "must be > 0 and ≤ 1e6, not 0");
  in.reader.Number("z", Below(0, 1));
  EXPECT_EQ(in.Detail("/here/z"), "must be ≥ 0 and < 1, not 1");
  in.reader.Integer("n", 1, 64);
  EXPECT_EQ(in.Detail("/here/n"), "must be a whole number ≥ 1 and ≤ 64, not 2.5");
  in.reader.Number("t", {8, 9});
  in.reader.Text("t");
  EXPECT_EQ(in.Detail("/here/t"), "must be ≥ 8 and ≤ 9, not 7\nmust be a text, not 7");
  in.reader.Choice("c", {"blue", "red", "white"});
  EXPECT_EQ(in.Detail("/here/c"), "must be blue, red or white, not the text \"green\"");
  in.reader.Bool("b", true);
  EXPECT_EQ(in.Detail("/here/b"), "must be true or false, not 1");
  in.reader.Number("s", {0, 1});
  EXPECT_EQ(in.Detail("/here/s"), "must be a number ≥ 0 and ≤ 1, not the text \"\"");
  in.reader.Number("gone", {0, 1});
  EXPECT_EQ(in.Detail("/here/gone"), "is required, a number ≥ 0 and ≤ 1");
}

TEST(Reader, ReportsUnknownFieldsWithTheNearestKnownName) {
  Read in(R"({"rest_volume_m": 1, "a/b~c": 2})");
  in.reader.Number("rest_volume_ml", {0, 1}, 0);
  in.reader.Number("expansion_ratio", {0, 1}, 0);
  in.reader.Finish();
  EXPECT_EQ(in.Detail("/here/rest_volume_m"), "unknown field; nearest known: rest_volume_ml");
  EXPECT_EQ(in.errors.size(), 2u);
  EXPECT_EQ(in.errors[1].pointer, "/here/a~1b~0c");
}

TEST(Reader, SaysAMissingObjectOnlyOnce) {
  Read in(R"({"list": {}, "text": "x"})");
  Reader missing = in.reader.Object("duty");
  missing.Number("frequency_hz", {0, 1});
  missing.Text("name");
  missing.Choice("kind", {"a"});
  missing.List("l", 1, 2);
  missing.Finish();
  Reader wrong = in.reader.Object("text");
  wrong.Number("frequency_hz", {0, 1});
  in.reader.List("list", 1, 16);
  EXPECT_EQ(in.errors,
            (Errors{{"/here/duty", "is required"},
                    {"/here/text", "must be an object, not the text \"x\""},
                    {"/here/list", "must be a list of 1 to 16 elements, not an object"}}));
}

TEST(Text, NearestIsByEditDistance) {
  const std::vector<std::string> names{"frequency_hz", "actuations", "simultaneous"};
  EXPECT_EQ(Nearest("frequnecy_hz", names), "frequency_hz");  // swapped neighbours
  EXPECT_EQ(Nearest("actuation", names), "actuations");
  EXPECT_EQ(Nearest("simultanous", names), "simultaneous");
  EXPECT_EQ(Nearest("x", {}), "");
}

TEST(Text, DecimalReadsBack) {
  EXPECT_EQ(Decimal(1e6), "1e6");
  EXPECT_EQ(Decimal(1e-5), "1e-5");
  EXPECT_EQ(Decimal(0.05), "0.05");
  EXPECT_EQ(Decimal(-3), "-3");
  EXPECT_EQ(Decimal(1.5e300), "1.5e300");
}

TEST(Text, ArticlesFollowTheFirstLetter) {
  EXPECT_EQ(WithArticle("ejector"), "an ejector");
  EXPECT_EQ(WithArticle("valve"), "a valve");
}

TEST(Text, ClipCutsBetweenCharacters) {
  EXPECT_EQ(Clip("aéé", 4), "aé…");
  EXPECT_EQ(Clip("abc", 3), "abc");
}

}  // namespace reader_test
}  // namespace plenum::api
