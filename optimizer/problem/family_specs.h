// The families of parts: what is asked of each of them, whoever asks. The registry has one row per
// family, with its table of fields.
#ifndef PLENUM_OPTIMIZER_PROBLEM_FAMILY_SPECS_H_
#define PLENUM_OPTIMIZER_PROBLEM_FAMILY_SPECS_H_

#include <array>
#include <span>
#include <string>
#include <vector>

#include "optimizer/problem/part_fields.h"
#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

// What a part of the family says of the kind of its design (kind.h).
enum class KindRole { kApart, kSource, kRegulator, kValve };

struct FamilySpec {
  Family family;
  const char* name;  // as in the catalogue; reservoirs have two families, one for each role
  std::span<const PartField> fields;
  std::size_t (*size)(const model::Parts& parts);
  const model::PartBasics& (*basics)(const model::Parts& parts, int part);
  int place = 0;         // in a parts list; of one group, then of the source
  bool in_line = false;  // in the line of each group
  std::array<bool, kConfigurations> in_source{};  // else in the source of these
  int Limits::*most = nullptr;                    // pieces in parallel; null: 1
  bool joins = false;            // lines or pieces of a source, from which it follows (joints.h)
  bool by_need = false;          // chosen by what it must bear, once all else is known
  bool made_to_measure = false;  // one may be made instead ("custom")
  KindRole kind_role = KindRole::kApart;
  bool on_rail = false;  // of the vacuum beside a pressure supply (PumpsRail)

  bool InSourceOf(Configuration configuration) const {
    return in_source[static_cast<std::size_t>(configuration)];
  }
};

// The registry, by the numbers of enum Family; in family_registry.cc alone, so that a program can
// be linked with one that has a further family.
std::span<const FamilySpec> Families();
// What it holds in plenum.
std::vector<FamilySpec> OwnFamilies();

const FamilySpec& SpecOf(Family family);

int FamilySize(const model::Parts& parts, Family family);
// How many of them, from the first on, a configuration has to choose from: of supplies from outside
// one, where no pump asks for a voltage of its own.
int ChoicesIn(const Problem& problem, Configuration configuration, Family family);
const model::PartBasics& BasicsOf(const model::Parts& parts, Family family, int part);
model::PartBasics& BasicsOf(model::Parts& parts, Family family, int part);
// Index of the part with this id; −1: the family has none.
int FindPart(const model::Parts& parts, Family family, const std::string& id);
// The family of the same name that a design of the configuration has: of a tank, its tank; of a
// source without a reservoir that of its vacuum.
Family FamilyIn(Configuration configuration, Family named);
// The family under whose name the catalogue and a request hold its parts: of a tank, the
// reservoirs.
Family CatalogueFamily(Family family);
// Whether a source of the configuration may do without a part of the family: a tank without a
// regulator.
bool MayLack(Configuration configuration, Family family);

int QuantityMax(const Problem& problem, Family family);
bool MadeToMeasureAllowed(const Problem& problem, Family family);

// Of the line of a group and of a configuration's source, in the order of a parts list.
std::vector<Family> LineFamilies();
std::vector<Family> SourceFamilies(const Problem& problem, Configuration configuration);
// Whether the source of a configuration has a part of the family.
bool IsInSource(const Problem& problem, Configuration configuration, const FamilySpec& spec);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PROBLEM_FAMILY_SPECS_H_
