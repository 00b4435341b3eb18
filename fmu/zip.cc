#include "fmu/zip.h"

#include <array>
#include <cstdint>

namespace plenum::fmu {
namespace {

constexpr std::uint32_t kFirstDay = 1 << 5 | 1;  // 1 January 1980

std::uint32_t Crc32(std::string_view bytes) {
  static const std::array<std::uint32_t, 256> kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < table.size(); ++i) {
      table[i] = i;
      for (int bit = 0; bit < 8; ++bit)
        table[i] = table[i] >> 1 ^ (table[i] & 1 ? 0xEDB88320u : 0u);
    }
    return table;
  }();
  std::uint32_t crc = ~0u;
  for (const char byte : bytes)
    crc = kTable[(crc ^ static_cast<unsigned char>(byte)) & 255] ^ crc >> 8;
  return ~crc;
}

void Put(std::string& to, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) to += static_cast<char>(value >> 8 * i & 255);
}

// What the local header and the entry of the directory have in common.
void PutHeader(std::string& to, const ZipEntry& entry, std::uint32_t crc) {
  const auto size = static_cast<std::uint32_t>(entry.bytes.size());
  Put(to, 10, 2);       // version needed: 1.0
  Put(to, 1 << 11, 2);  // the name is UTF-8
  Put(to, 0, 2);        // stored
  Put(to, 0, 2);        // midnight
  Put(to, kFirstDay, 2);
  Put(to, crc, 4);
  Put(to, size, 4);
  Put(to, size, 4);
  Put(to, static_cast<std::uint32_t>(entry.name.size()), 2);
  Put(to, 0, 2);  // no extra field
}

}  // namespace

std::string Zip(const std::vector<ZipEntry>& entries) {
  std::string archive, directory;
  for (const ZipEntry& entry : entries) {
    const std::uint32_t crc = Crc32(entry.bytes);
    const auto at = static_cast<std::uint32_t>(archive.size());
    Put(archive, 0x04034B50, 4);
    PutHeader(archive, entry, crc);
    archive += entry.name;
    archive += entry.bytes;
    Put(directory, 0x02014B50, 4);
    Put(directory, 3 << 8 | 10, 2);  // made on Unix, version 1.0
    PutHeader(directory, entry, crc);
    Put(directory, 0, 2);  // no comment
    Put(directory, 0, 2);  // first disk
    Put(directory, 0, 2);  // no internal attributes
    Put(directory, 0100644u << 16, 4);
    Put(directory, at, 4);
    directory += entry.name;
  }
  const auto at = static_cast<std::uint32_t>(archive.size());
  const auto count = static_cast<std::uint32_t>(entries.size());
  archive += directory;
  Put(archive, 0x06054B50, 4);
  Put(archive, 0, 4);  // the only disk
  Put(archive, count, 2);
  Put(archive, count, 2);
  Put(archive, static_cast<std::uint32_t>(directory.size()), 4);
  Put(archive, at, 4);
  Put(archive, 0, 2);  // no comment
  return archive;
}

}  // namespace plenum::fmu
