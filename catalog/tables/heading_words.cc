#include "catalog/tables/heading_words.h"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "catalog/tables/heading_vocabulary.h"
#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

struct Letter {
  std::string_view from, to;
};
constexpr Letter kLetters[] = {
    {"ä", "ae"},         {"ö", "oe"},         {"ü", "ue"},         {"Ä", "ae"},
    {"Ö", "oe"},         {"Ü", "ue"},         {"ß", "ss"},         {"é", "e"},
    {"è", "e"},          {"ê", "e"},          {"É", "e"},          {"à", "a"},
    {"ç", "c"},          {"ô", "o"},          {"î", "i"},          {"û", "u"},
    {"⌀", " diameter "}, {"Ø", " diameter "}, {"ø", " diameter "}, {"Σ", " total "},
    {"#", " number "},   {"№", " number "}};

struct NotationWords {
  FlowNotation notation;
  std::vector<std::string> words;  // sorted
};
const std::vector<NotationWords>& Notations() {
  static const std::vector<NotationWords> kNotations = {
      {FlowNotation::kCv, {"cv"}},
      {FlowNotation::kKv, {"kv"}},
      {FlowNotation::kQn, {"qn"}},
      {FlowNotation::kQn, {"qnn"}},
      {FlowNotation::kQn, {"nenndurchfluss"}},
      {FlowNotation::kQn, {"normalnenndurchfluss"}},
      {FlowNotation::kQn, {"flow", "nominal", "rate", "standard"}},
      {FlowNotation::kQn, {"flow", "nominal", "standard"}},
      {FlowNotation::kQn, {"flow", "nominal", "rate"}},
      {FlowNotation::kQn, {"flow", "nominal"}},
      {FlowNotation::kOrifice, {"diameter", "orifice"}},
      {FlowNotation::kOrifice, {"orifice"}},
      {FlowNotation::kOrifice, {"nennweite"}},
      {FlowNotation::kOrifice, {"dn"}},
      {FlowNotation::kEffectiveArea, {"area", "effective"}},
      {FlowNotation::kEffectiveArea, {"area", "effective", "orifice"}},
      {FlowNotation::kEffectiveArea, {"querschnitt", "wirksamer"}},
  };
  return kNotations;
}

void AddWords(std::string_view words, std::vector<std::string>& to) {
  for (const std::string_view word : Split(words, ' '))
    if (!word.empty()) to.emplace_back(word);
}

using Meanings = std::map<std::string_view, std::string_view>;

const Meanings& GeneralMeanings() {
  static const Meanings kMeanings = [] {
    Meanings all;
    for (const HeadingWord& word : HeadingWords()) all[word.word] = word.meaning;
    return all;
  }();
  return kMeanings;
}

// The words of a heading, with single blanks around each, several that say one thing as one.
std::string Idiomatic(std::string_view heading) {
  const std::string apart = PlainWords(heading);
  std::string plain = " ";
  for (const std::string_view word : Split(apart, ' '))
    if (!word.empty()) plain.append(word).append(" ");
  for (const auto& [words, meaning] : HeadingIdioms()) {
    const std::string whole = " " + std::string(words) + " ";
    const std::size_t at = plain.find(whole);
    if (at != std::string::npos) plain.replace(at, whole.size(), " " + std::string(meaning) + " ");
  }
  return plain;
}

std::vector<std::string> Meaning(std::string_view family, std::string_view heading,
                                 const Meanings& meanings) {
  std::vector<std::string> general, words;
  const std::string plain = Idiomatic(heading);
  for (const std::string_view word : Split(plain, ' ')) {
    if (word.empty()) continue;
    const auto meaning = meanings.find(word);
    AddWords(meaning == meanings.end() ? word : meaning->second, general);
  }
  for (const std::string& word : general) {
    const auto& all = FamilyWords();
    const auto own = std::find_if(all.begin(), all.end(), [&](const FamilyWord& one) {
      return one.family == family && one.word == word;
    });
    AddWords(own == all.end() ? std::string_view(word) : own->meaning, words);
  }
  std::sort(words.begin(), words.end());
  words.erase(std::unique(words.begin(), words.end()), words.end());
  return words;
}

}  // namespace

std::string PlainWords(std::string_view text) {
  std::string plain;
  while (!text.empty()) {
    const auto* letter = std::find_if(std::begin(kLetters), std::end(kLetters),
                                      [&](const Letter& l) { return text.starts_with(l.from); });
    if (letter != std::end(kLetters)) {
      plain += letter->to;
      text.remove_prefix(letter->from.size());
      continue;
    }
    char c = text[0];
    text.remove_prefix(1);
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    plain += (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ? c : ' ';
  }
  return plain;
}

std::vector<std::string> FieldWords(std::string_view family, std::string_view heading) {
  return Meaning(family, heading, GeneralMeanings());
}

std::vector<std::string> WordsWithUnit(std::string_view family, std::string_view heading) {
  static const Meanings kMeanings = [] {
    Meanings all = GeneralMeanings();
    for (const HeadingWord& word : HeadingWordsWithUnit()) all[word.word] = word.meaning;
    return all;
  }();
  return Meaning(family, heading, kMeanings);
}

std::optional<FlowNotation> TakeNotation(std::vector<std::string>& words) {
  const NotationWords* longest = nullptr;
  for (const NotationWords& known : Notations())
    if (std::includes(words.begin(), words.end(), known.words.begin(), known.words.end()) &&
        (longest == nullptr || known.words.size() > longest->words.size()))
      longest = &known;
  if (longest == nullptr) return std::nullopt;
  for (const std::string& word : longest->words) std::erase(words, word);
  return longest->notation;
}

bool IsTotalLabel(std::string_view cell) {
  static constexpr std::string_view kLabels[] = {
      "total",   "totals",     "sum",  "summe",        "gesamt", "gesamtsumme", "subtotal",
      "average", "mittelwert", "mean", "durchschnitt", "count",  "anzahl",      "zwischensumme"};
  const std::string plain = PlainWords(cell);
  const std::size_t first = plain.find_first_not_of(' ');
  if (first == std::string::npos) return false;
  const std::string word = plain.substr(first, plain.find(' ', first) - first);
  return std::find(std::begin(kLabels), std::end(kLabels), word) != std::end(kLabels);
}

}  // namespace plenum::catalog
