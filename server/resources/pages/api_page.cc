#include "server/resources/pages/api_page.h"

#include <string>

#include "api/catalogue/stores.h"

namespace plenum::server {
namespace {

constexpr char kApiStyle[] = R"css(
body { font: 16px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 60rem; padding: 0 1rem; color: #1a1a1a; background: #fff }
h2 { font-size: 1.1rem; margin: 2.2rem 0 .2rem } code, pre { font-size: .85rem }
b { display: inline-block; min-width: 4.5rem; font-family: monospace }
pre { background: #f3f3f0; padding: .8rem; overflow: auto; max-height: 28rem }
table { border-collapse: collapse } td { padding: .15rem 1rem .15rem 0; vertical-align: top }
summary { cursor: pointer } @media (prefers-color-scheme: dark) {
body { color: #eee; background: #1b1b1b } pre { background: #2a2a2a } a { color: #9cf } })css";

constexpr char kScript[] = R"js(
const add = (to, name, text) => { const e = document.createElement(name); if (text !== undefined) e.textContent = text; to.append(e); return e }
const fold = (to, title, value) => { const d = add(to, 'details'); add(d, 'summary', title); add(d, 'pre', JSON.stringify(value, null, 2)) }
fetch('/openapi.json').then(r => r.json()).then(api => {
  const main = document.querySelector('main')
  const find = v => v.$ref ? v.$ref.split('/').slice(1).reduce((at, step) => at[step], api) : v
  add(main, 'p', api.info.description)
  for (const [path, methods] of Object.entries(api.paths)) for (const [method, o] of Object.entries(methods)) {
    const h = add(main, 'h2'); h.id = method + path; add(h, 'b', method.toUpperCase()); add(h, 'code', path)
    add(main, 'p', o.summary)
    const parameters = o.parameters.map(find)
    if (parameters.length) { const d = add(main, 'details'); add(d, 'summary', parameters.length + ' parameters'); const t = add(d, 'table')
      for (const p of parameters) { const r = add(t, 'tr'); add(add(r, 'td'), 'code', p.name); add(r, 'td', p.in); add(r, 'td', p.description || '') } }
    for (const [media, c] of Object.entries(o.requestBody?.content || {})) {
      if (c.example) fold(main, 'Example of the body', c.example)
      fold(main, 'Body, ' + media, find(c.schema)) }
    for (const [status, response] of Object.entries(o.responses)) for (const [media, c] of Object.entries(find(response).content || { '': {} }))
      if (status !== 'default') fold(main, status + ' ' + media, c.schema ? find(c.schema) : {}) }
}))js";

// The browser runs and loads what has these digests and nothing else.
std::string Base64OfSha256(const std::string& text) {
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::string hex = catalog::Sha256(text);
  std::string base64;
  unsigned bits = 0, count = 0;
  for (const char digit : hex) {
    bits = bits << 4 | static_cast<unsigned>(digit <= '9' ? digit - '0' : digit - 'a' + 10);
    for (count += 4; count >= 6; count -= 6) base64 += kDigits[bits >> (count - 6) & 63];
  }
  base64 += kDigits[bits << (6 - count) & 63];  // 256 bits: four are left
  return base64 + "=";
}

}  // namespace

Reply GetApiPage(const Call&) {
  static const std::string kPolicy = "default-src 'none'; connect-src 'self'; script-src 'sha256-" +
                                     Base64OfSha256(kScript) + "'; style-src 'sha256-" +
                                     Base64OfSha256(kApiStyle) +
                                     "'; base-uri 'none'; form-action 'none'; "
                                     "frame-ancestors 'none'";
  static const std::string kPage = std::string(
                                       "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\">"
                                       "<meta name=\"viewport\" content=\"width=device-width\">"
                                       "<title>plenum: the service</title><style>") +
                                   kApiStyle +
                                   "</style><main><h1>plenum: the service</h1></main><script>" +
                                   kScript + "</script></html>\n";
  return {200,
          "text/html; charset=utf-8",
          kPage,
          {{"Content-Security-Policy", kPolicy},
           {"X-Content-Type-Options", "nosniff"},
           {"Cache-Control", "no-cache"}},
          {}};
}

}  // namespace plenum::server
