# Writes OUTPUT, a C++ source with the files below FOLDER as bytes.
# usage: cmake -D FOLDER=web/dist -D OUTPUT=page_files.cc -P embed.cmake
file(GLOB_RECURSE files RELATIVE "${FOLDER}" "${FOLDER}/*")
list(SORT files)
set(arrays "")
set(rows "")
set(index 0)
foreach(file IN LISTS files)
  file(READ "${FOLDER}/${file}" bytes HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
  string(REGEX REPLACE "(0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,)" "\\1\n"
    bytes "${bytes}")
  string(APPEND arrays "constexpr unsigned char kFile${index}[] = {\n${bytes}};\n")
  string(APPEND rows "    {\"/${file}\", {reinterpret_cast<const char*>(kFile${index}), sizeof kFile${index}}},\n")
  math(EXPR index "${index} + 1")
endforeach()
file(WRITE "${OUTPUT}" "#include \"server/resources/pages/page_files.h\"

namespace plenum::server {
namespace {
${arrays}}  // namespace

std::span<const PageFile> PageFiles() {
  static const PageFile kFiles[] = {
${rows}  };
  return kFiles;
}

}  // namespace plenum::server
")
