// The built web page, part of the program: the files of web/dist.
#ifndef PLENUM_SERVER_RESOURCES_PAGES_PAGE_FILES_H_
#define PLENUM_SERVER_RESOURCES_PAGES_PAGE_FILES_H_

#include <span>
#include <string_view>

namespace plenum::server {

struct PageFile {
  std::string_view path;  // "/index.html"
  std::string_view bytes;
};

// Defined in the source that web/embed.cmake writes when the program is built.
std::span<const PageFile> PageFiles();

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_PAGES_PAGE_FILES_H_
