#include "server/call/coding/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <stdexcept>

namespace plenum::server {
namespace {

constexpr int kLevel = 6;
constexpr int kRawWindow = -15;  // 32 KiB, without a frame
constexpr int kMemory = 8;
constexpr std::size_t kFeedBytes = 1 << 30;      // zlib counts in 32 bits
constexpr std::size_t kStoredBytesMax = 65'535;  // of a block

// No name, no time, of an unknown system.
constexpr std::string_view kHead("\x1f\x8b\x08\0\0\0\0\0\0\xff", 10);
constexpr std::string_view kLastBlock("\x03\0", 2);  // empty, of fixed codes

class Deflater {
 public:
  Deflater() {
    if (deflateInit2(&stream_, kLevel, Z_DEFLATED, kRawWindow, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
      throw std::bad_alloc();
  }
  ~Deflater() { deflateEnd(&stream_); }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  void Take(std::string_view text, int flush, std::string& out) {
    char piece[64 << 10];
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
    stream_.avail_in = static_cast<uInt>(text.size());
    do {
      stream_.next_out = reinterpret_cast<Bytef*>(piece);
      stream_.avail_out = sizeof piece;
      const int result = deflate(&stream_, flush);
      if (result != Z_OK && result != Z_BUF_ERROR) throw std::runtime_error("deflate failed");
      out.append(piece, sizeof piece - stream_.avail_out);
    } while (stream_.avail_out == 0);
  }

 private:
  z_stream stream_{};
};

void AppendLittleEndian(unsigned long value, int bytes, std::string& text) {
  for (int i = 0; i < bytes; ++i)
    text += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
}

unsigned long CrcOf(std::string_view text) {
  return crc32_z(crc32(0, nullptr, 0), reinterpret_cast<const Bytef*>(text.data()), text.size());
}

// A short text in blocks that hold it as it is (RFC 1951, 3.2.4).
Deflated Stored(std::string_view text) {
  Deflated stored{"", CrcOf(text), text.size()};
  for (; !text.empty(); text.remove_prefix(std::min(text.size(), kStoredBytesMax))) {
    const std::string_view piece = text.substr(0, kStoredBytesMax);
    stored.blocks += '\0';
    AppendLittleEndian(piece.size(), 2, stored.blocks);
    AppendLittleEndian(~piece.size(), 2, stored.blocks);
    stored.blocks += piece;
  }
  return stored;
}

}  // namespace

Deflated Deflate(std::string_view text) {
  Deflated deflated{"", CrcOf(text), text.size()};
  Deflater deflater;
  do {
    const std::string_view piece = text.substr(0, kFeedBytes);
    text.remove_prefix(piece.size());
    deflater.Take(piece, text.empty() ? Z_SYNC_FLUSH : Z_NO_FLUSH, deflated.blocks);
  } while (!text.empty());
  deflated.blocks.shrink_to_fit();
  return deflated;
}

std::vector<Bytes> GzipOf(std::string_view before, const std::shared_ptr<const Deflated>& text,
                          std::string_view after) {
  const Deflated first = Stored(before), last = Stored(after);
  unsigned long crc = first.crc;
  for (const Deflated* next : {text.get(), &last})
    crc = crc32_combine(crc, next->crc, static_cast<z_off_t>(next->size));
  std::string end = last.blocks;
  end += kLastBlock;
  AppendLittleEndian(crc, 4, end);
  AppendLittleEndian(first.size + text->size + last.size, 4, end);
  return {std::make_shared<const std::string>(std::string(kHead) + first.blocks),
          Bytes(text, &text->blocks), std::make_shared<const std::string>(std::move(end))};
}

}  // namespace plenum::server
