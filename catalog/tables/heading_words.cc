#include "catalog/tables/heading_words.h"

#include <algorithm>
#include <map>
#include <utility>

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

// A word of a heading and the words of field names that it stands for; none: it says nothing.
constexpr std::pair<std::string_view, std::string_view> kWords[] = {
    {"maximum", "max"},
    {"maximal", "max"},
    {"maximale", "max"},
    {"maximaler", "max"},
    {"highest", "max"},
    {"hoechster", "max"},
    {"minimum", "min"},
    {"minimal", "min"},
    {"minimale", "min"},
    {"minimaler", "min"},
    {"lowest", "min"},
    {"mass", "mass"},
    {"masse", "mass"},
    {"gewicht", "mass"},
    {"weight", "mass"},
    {"wt", "mass"},
    {"poids", "mass"},
    {"gewichts", "mass"},
    {"metergewicht", "mass"},
    {"druck", "pressure"},
    {"pression", "pressure"},
    {"betriebsdruck", "pressure"},
    {"operating", ""},
    {"working", ""},
    {"rated", ""},
    {"zul", ""},
    {"zulaessiger", ""},
    {"maximaldruck", "max pressure"},
    {"hoechstdruck", "max pressure"},
    {"pmax", "max pressure"},
    {"pmin", "min pressure"},
    {"mindestdruck", "min pressure"},
    {"eingangsdruck", "inlet pressure"},
    {"ausgangsdruck", "outlet pressure"},
    {"fuelldruck", "fill pressure"},
    {"volumen", "volume"},
    {"innenvolumen", "internal volume"},
    {"nennvolumen", "internal volume"},
    {"tankvolumen", "internal volume"},
    {"inner", "inner"},
    {"aussenvolumen", "body volume"},
    {"bauvolumen", "body volume"},
    {"envelope", "body"},
    {"koerpervolumen", "body volume"},
    {"durchmesser", "diameter"},
    {"dia", "diameter"},
    {"diam", "diameter"},
    {"innen", "inner"},
    {"inside", "inner"},
    {"innendurchmesser", "inner diameter"},
    {"aussen", "outer"},
    {"outside", "outer"},
    {"aussendurchmesser", "outer diameter"},
    {"schlauch", "tube"},
    {"schlauchaussendurchmesser", "tube outer diameter"},
    {"od", "outer diameter"},
    {"werkstoff", "material"},
    {"gewinde", "thread"},
    {"anschluss", "port"},
    {"chemie", "chemistry"},
    {"bauform", "style"},
    {"spannung", "voltage"},
    {"nennspannung", "nominal voltage"},
    {"nominal", "nominal"},
    {"strom", "current"},
    {"dauerstrom", "max current"},
    {"maximalstrom", "max current"},
    {"kapazitaet", "capacity"},
    {"zellen", "cells"},
    {"serie", "series"},
    {"reihe", "series"},
    {"baureihe", "series"},
    {"leistung", "power"},
    {"spulenleistung", "coil power"},
    {"leistungsaufnahme", "power"},
    {"consumption", ""},
    {"kanaele", "channels"},
    {"channel", "channels"},
    {"stationen", "stations"},
    {"funktion", "function"},
    {"schaltzeit", "response time"},
    {"ansprechzeit", "response time"},
    {"switching", "response"},
    {"filling", "fill"},
    {"belueften", "fill"},
    {"inflate", "fill"},
    {"vent", "exhaust"},
    {"venting", "exhaust"},
    {"entlueften", "exhaust"},
    {"deflate", "exhaust"},
    {"c", "sonic conductance"},
    {"leitwert", "sonic conductance"},
    {"pneumatischer", ""},
    {"b", "critical ratio"},
    {"druckverhaeltnis", "critical ratio"},
    {"kritisches", ""},
    {"hersteller", "manufacturer"},
    {"maker", "manufacturer"},
    {"brand", "manufacturer"},
    {"make", "manufacturer"},
    {"marke", "manufacturer"},
    {"fabricant", "manufacturer"},
    {"mfr", "manufacturer"},
    {"mfg", "manufacturer"},
    {"artikelnummer", "part number"},
    {"bestellnummer", "part number"},
    {"teilenummer", "part number"},
    {"artikel", "part"},
    {"article", "part"},
    {"bestell", "part"},
    {"order", "part"},
    {"ordering", "part"},
    {"teile", "part"},
    {"nr", "number"},
    {"no", "number"},
    {"nummer", "number"},
    {"code", "number"},
    {"pn", "part number"},
    {"mpn", "part number"},
    {"model", "part number"},
    {"modell", "part number"},
    {"reference", "part number"},
    {"bestellbezeichnung", "part number"},
    {"typenbezeichnung", "part number"},
    {"preis", "price"},
    {"prix", "price"},
    {"stueckpreis", "price"},
    {"einzelpreis", "price"},
    {"bemerkung", "notes"},
    {"bemerkungen", "notes"},
    {"remarks", "notes"},
    {"comment", "notes"},
    {"comments", "notes"},
    {"note", "notes"},
    {"anmerkung", "notes"},
    {"datasheet", "documents"},
    {"datenblatt", "documents"},
    {"lieferbar", "orderable"},
    {"of", ""},
    {"the", ""},
    {"per", ""},
    {"pro", ""},
    {"je", ""},
    {"der", ""},
    {"des", ""},
    {"value", ""},
    {"wert", ""},
    {"unit", ""},
    {"stueck", ""},
    {"piece", ""},
    {"in", ""},
    {"cylinder", ""},
    {"flasche", ""},
    {"net", ""},
    {"netto", ""},
    {"metre", ""},
    {"meter", ""},
};

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

std::vector<std::string> FieldWords(std::string_view heading) {
  static const std::map<std::string_view, std::string_view> kMeanings(std::begin(kWords),
                                                                      std::end(kWords));
  std::vector<std::string> words;
  const std::string plain = PlainWords(heading);
  for (const std::string_view word : Split(plain, ' ')) {
    if (word.empty()) continue;
    const auto meaning = kMeanings.find(word);
    AddWords(meaning == kMeanings.end() ? word : meaning->second, words);
  }
  std::sort(words.begin(), words.end());
  words.erase(std::unique(words.begin(), words.end()), words.end());
  return words;
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
