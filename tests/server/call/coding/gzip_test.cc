// What is compressed piece by piece is read by zlib's own reader of gzip, which checks the sum and
// the length at its end.
#include "server/call/coding/gzip.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>

#include "server/call/coding/accepted.h"
#include "server/jobs/stored_results.h"

namespace plenum::server {
namespace gzip_test {

// The text of exactly one member of gzip; "not gzip" for anything else.
std::string Read(const std::vector<Bytes>& pieces) {
  std::string bytes;
  for (const Bytes& piece : pieces) bytes += *piece;
  z_stream stream{};
  inflateInit2(&stream, 15 + 16);
  stream.next_in = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string text;
  int result = Z_OK;
  while (result == Z_OK) {
    char piece[10'000];
    stream.next_out = reinterpret_cast<Bytef*>(piece);
    stream.avail_out = sizeof piece;
    result = inflate(&stream, Z_NO_FLUSH);
    text.append(piece, sizeof piece - stream.avail_out);
  }
  const bool whole = result == Z_STREAM_END && stream.avail_in == 0;
  inflateEnd(&stream);
  return whole ? text : "not gzip";
}

std::shared_ptr<const Deflated> Compressed(const std::string& text) {
  return std::make_shared<const Deflated>(Deflate(text));
}

TEST(Gzip, TextsTogetherAreOneMember) {
  std::mt19937 random(3);
  for (const std::size_t size : {0, 1, 100, 65'535, 65'536, 3'000'000}) {
    std::string noise(size, ' '), words;
    for (char& c : noise) c = static_cast<char>(random());
    while (words.size() < size) words += "word " + std::to_string(random() % 1000);
    for (const std::string& text : {noise, words}) {
      EXPECT_EQ(Read(GzipOf("{\"result\":", Compressed(text), "}\n")),
                "{\"result\":" + text + "}\n");
      EXPECT_EQ(Read(GzipOf("", Compressed(text), "")), text);
      EXPECT_EQ(Read(GzipOf(text, Compressed("[]"), text)), text + "[]" + text);
    }
    EXPECT_LE(Deflate(words).blocks.size(), words.size() / 2 + 100);
  }
}

TEST(Gzip, AResultIsCompressedOnce) {
  StoredResults results;
  const std::string text = "[\"" + std::string(100'000, '1') + "\"]";
  const Bytes stored = results.Get("a", [&] { return text; });
  const auto first = results.Compressed(stored);
  ASSERT_TRUE(first);
  EXPECT_EQ(Read(GzipOf("", first, "")), text);
  EXPECT_EQ(results.Compressed(stored), first);
  // Another text under the same id is another one.
  results.Forget("a");
  const Bytes later = results.Get("a", [] { return std::string("[2]"); });
  EXPECT_EQ(Read(GzipOf("", results.Compressed(later), "")), "[2]");
}

TEST(Accepted, GzipWhereTheClientLikesItAsWell) {
  const auto wants = [](std::optional<std::string> header) {
    Call call;
    call.header = [&](const char* name) {
      return std::string_view(name) == "Accept-Encoding" ? header : std::nullopt;
    };
    return WantsGzip(call);
  };
  for (const char* yes : {"gzip", "deflate, gzip", "GZIP;q=0.5", "br;q=1.0, gzip;q=0.8", "*",
                          "x-gzip", "identity;q=0.5, gzip", "gzip ; q=0.2 , br", "gzip,,"})
    EXPECT_TRUE(wants(yes)) << yes;
  for (const char* no : {"", "br", "identity", "gzip;q=0", "gzip;q=0.0, *", "*;q=0", ",", ";q=1",
                         "identity, gzip;q=0.5", "gzipped"})
    EXPECT_FALSE(wants(no)) << no;
  EXPECT_FALSE(wants(std::nullopt));
}

}  // namespace gzip_test
}  // namespace plenum::server
