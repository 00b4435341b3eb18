// Requirements, amounts and parts in words, for sentences about designs.
#ifndef PLENUM_API_DESIGN_GIVEN_REQUIREMENT_WORDS_H_
#define PLENUM_API_DESIGN_GIVEN_REQUIREMENT_WORDS_H_

#include <string>

#include "api/design/design_document.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

// "1.31", to four digits.
std::string Told(double number);

// "the rise time of leg is 0.62 s, asked is 0.5 s at most"
std::string MarginInWords(const optimizer::Margin& margin, const optimizer::Problem& problem);

// What an entry of a conflict names by its pointer: "rise time of leg" in "s", "excluded parts";
// the pointer itself where it has no other name. `request` has the groups' names.
struct Demanded {
  std::string name, unit;
};
Demanded DemandInWords(const std::string& pointer, const Json& request);

// "1.31 kg", "2.4 L", "120 €", "3.1 Wh"; of a weighted sum the bare number.
std::string ObjectiveInWords(double objective, const optimizer::Objective& of);

// "valve SMC VQ110U-5M-M5 of leg", with its number of pieces where there are several.
std::string PartInWords(const optimizer::Choice& choice, const optimizer::Problem& problem,
                        const Rows& rows);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_GIVEN_REQUIREMENT_WORDS_H_
