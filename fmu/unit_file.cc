#include "fmu/unit_file.h"

#include <string_view>

#include "fmu/unit_description.h"
#include "fmu/unit_text.h"
#include "fmu/zip.h"

#ifdef PLENUM_UNIT_BINARY
// The binary of fmi2.cc, as it was built.
asm(".pushsection .rodata\n"
    ".global plenum_unit_binary, plenum_unit_binary_end\n"
    "plenum_unit_binary: .incbin \"" PLENUM_UNIT_BINARY
    "\"\n"
    "plenum_unit_binary_end: .byte 0\n"
    ".popsection\n");
extern "C" const char plenum_unit_binary[], plenum_unit_binary_end[];
#endif

namespace plenum::fmu {
namespace {

std::string_view Binary() {
#ifdef PLENUM_UNIT_BINARY
  return {plenum_unit_binary, plenum_unit_binary_end};
#else
  return {};
#endif
}

}  // namespace

bool MakesUnits() { return !Binary().empty(); }

std::string UnitFile(const Unit& unit, const std::string& tool) {
  if (!MakesUnits()) return {};
  const std::string text = WriteUnit(unit);
  const std::string description = DescriptionOf(unit, GuidOf(text), tool);
  return Zip({{"modelDescription.xml", description},
              {"binaries/linux64/" + std::string(kModelIdentifier) + ".so", Binary()},
              {"resources/" + std::string(kUnitFile), text}});
}

}  // namespace plenum::fmu
