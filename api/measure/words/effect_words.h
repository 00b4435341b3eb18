// An effect with its numbers as a sentence for a person: what it does on the rig that was measured,
// in litres, per cent and seconds.
#ifndef PLENUM_API_MEASURE_WORDS_EFFECT_WORDS_H_
#define PLENUM_API_MEASURE_WORDS_EFFECT_WORDS_H_

#include <string>

#include "calibration/values/dataset.h"
#include "model/effects/effect.h"

namespace plenum::api {

// What an effect is told against: the rig of the first run, and the highest reading of all.
struct Scale {
  model::Ambient ambient;
  model::Chamber chamber;
  double highest_pa = 0.0;
};
// Of an effect of one of several chambers that chamber's.
Scale ScaleOf(const calibration::Dataset& dataset, const model::Effect& effect);

// "it leaks 0.6 L/min at 700 kPa gauge, 5 % of a fill each minute"; of a learned term nothing.
std::string EffectInWords(const model::Effect& effect, const Scale& scale);

// "source pressure is 149.9 kPa gauge, 13 % less than declared", both in the unit.
std::string NumberInWords(const std::string& name, double declared, double fitted,
                          const std::string& unit);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_WORDS_EFFECT_WORDS_H_
