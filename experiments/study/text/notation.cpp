// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/notation.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

namespace polhode::study::inline text {

namespace {

/// 3.20e-05 → 3.2e-5, 1.00e+06 → 1e6.
std::string without_padding(const std::string& printed) {
  const auto e = printed.find('e');
  std::string mantissa = printed.substr(0, e);
  if (mantissa.find('.') != std::string::npos) {
    mantissa.erase(mantissa.find_last_not_of('0') + 1);
    if (mantissa.back() == '.') mantissa.pop_back();
  }
  return fmt::format(FMT_COMPILE("{}e{}"), mantissa, std::atoi(printed.c_str() + e + 1));
}

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }
bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

template <class Escape>
std::string escaped(std::string_view text, Escape escape) {
  std::string out;
  out.reserve(text.size() + 8);
  for (const char c : text) {
    if (is_control(c)) out += ' ';
    else if (const std::string_view replacement = escape(c); !replacement.empty()) out += replacement;
    else out += c;
  }
  return out;
}

}  // namespace

std::string number(double value, int digits) {
  if (!std::isfinite(value)) return "not finite";
  const double size = std::abs(value);
  if (size > 0 && (size < 1e-3 || size >= 1e6)) return without_padding(fmt::format("{:.{}e}", value, digits - 1));
  if (size >= std::pow(10.0, digits)) return fmt::format("{:.0f}", value);
  return fmt::format("{:.{}g}", value, digits);
}

std::string rounded(double value) { return number(value, 5); }

std::string rounded(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0' && std::isfinite(value) ? rounded(value) : text;
}

std::string scientific(double value) {
  for (int precision = 0; precision < 17; ++precision) {
    auto printed = fmt::format("{:.{}e}", value, precision);
    if (std::strtod(printed.c_str(), nullptr) == value) return without_padding(printed);
  }
  return without_padding(fmt::format("{:.16e}", value));
}

std::string exact_number(double value) {
  if (!std::isfinite(value)) return "not finite";
  const double size = std::abs(value);
  if (size > 0 && (size < 1e-3 || size >= 1e6)) return scientific(value);
  return fmt::format("{}", value);
}

std::string count(std::size_t n, std::string_view noun) { return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s"); }

std::string words(const std::vector<std::string>& items) {
  std::string out;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) out += i + 1 == items.size() ? " and " : ", ";
    out += items[i];
  }
  return out;
}

std::vector<std::string> first_items(std::vector<std::string> items, std::size_t most) {
  if (items.size() <= most) return items;
  const std::size_t rest = items.size() - most;
  items.resize(most);
  items.push_back(fmt::format("{} more", rest));
  return items;
}

std::string html(std::string_view text) {
  return escaped(text, [](char c) -> std::string_view {
    switch (c) {
      case '&': return "&amp;";
      case '<': return "&lt;";
      case '>': return "&gt;";
      case '"': return "&quot;";
      case '\'': return "&#39;";
      default: return {};
    }
  });
}

std::string markdown(std::string_view text) {
  return escaped(text, [](char c) -> std::string_view {
    switch (c) {
      case '|': return "\\|";
      case '_': return "\\_";
      case '*': return "\\*";
      case '`': return "\\`";
      case '<': return "&lt;";
      case '&': return "&amp;";
      case '\\': return "\\\\";
      case '[': return "\\[";
      default: return {};
    }
  });
}

namespace {

/// LaTeX of the characters beyond ASCII that sentences and captions use; pdfTeX has the others, such as ½ and ²,
/// by inputenc and textcomp.
std::string_view tex_of_character(std::string_view character) {
  constexpr std::pair<std::string_view, std::string_view> known[] = {
      {"α", "\\alpha"},  {"β", "\\beta"},    {"γ", "\\gamma"},    {"δ", "\\delta"},  {"ε", "\\varepsilon"},
      {"θ", "\\theta"},  {"λ", "\\lambda"},  {"μ", "\\mu"},       {"ξ", "\\xi"},     {"π", "\\pi"},
      {"ρ", "\\rho"},    {"σ", "\\sigma"},   {"τ", "\\tau"},      {"φ", "\\varphi"}, {"ψ", "\\psi"},
      {"ω", "\\omega"},  {"Δ", "\\Delta"},   {"Φ", "\\Phi"},      {"Σ", "\\Sigma"},  {"Ω", "\\Omega"},
      {"√", "\\surd"},   {"∝", "\\propto"},  {"≤", "\\leq"},      {"≥", "\\geq"},    {"≈", "\\approx"},
      {"→", "\\to"},     {"−", "-"},         {"′", "^{\\prime}"}, {"ᵀ", "^{T}"},     {"⁻", "^{-}"},
      {"₋", "_{-}"},     {"ₕ", "_{h}"},      {"‖", "\\|"},        {"⟨", "\\langle"}, {"⟩", "\\rangle"},
      {"∞", "\\infty"},  {"∂", "\\partial"}, {"ᵖ", "^{p}"},       {"ⁿ", "^{n}"},     {"⁴", "^{4}"},
      {"⁵", "^{5}"},     {"⁶", "^{6}"},      {"⁷", "^{7}"},       {"⁸", "^{8}"},     {"⁹", "^{9}"},
      {"⁰", "^{0}"},     {"₀", "_{0}"},      {"₁", "_{1}"},       {"₂", "_{2}"},     {"₃", "_{3}"},
      {"ẋ", "\\dot{x}"}, {"ẏ", "\\dot{y}"},  {"ż", "\\dot{z}"},   {"ḋ", "\\dot{d}"}, {"̇", "\\dot{}"},
      {"≠", "\\neq"}};
  for (const auto& [one, command] : known) {
    if (one == character) return command;
  }
  return {};
}

/// True for a character beyond ASCII that pdfTeX sets by inputenc, the fonts of T1 and textcomp: Western letters, their
/// signs, quotes and dashes.
bool is_set_by_tex(std::string_view character) {
  constexpr std::string_view punctuation[] = {"–", "—", "‘", "’", "‚", "“", "”", "„",
                                              "†", "‡", "•", "…", "‰", "€", "™"};
  const auto first = static_cast<unsigned char>(character.front());
  if (first == 0xC2 || first == 0xC3) return true;  // U+00A0 … U+00FF
  return std::find(std::begin(punctuation), std::end(punctuation), character) != std::end(punctuation);
}

/// "[U+4E2D]": what stands for a character that no font of the document has.
std::string code_of(std::string_view character) {
  unsigned code = static_cast<unsigned char>(character.front()) & (0xFFU >> (character.size() + 1));
  for (const char c : character.substr(1)) code = code << 6U | (static_cast<unsigned char>(c) & 0x3FU);
  return fmt::format("[U+{:04X}]", code);
}

/// Number of bytes of the UTF-8 character that begins with this byte.
std::size_t bytes_of_character(char first) {
  const auto byte = static_cast<unsigned char>(first);
  return byte >= 0xF0 ? 4 : byte >= 0xE0 ? 3 : byte >= 0xC0 ? 2 : 1;
}

}  // namespace

std::string tex(std::string_view text) {
  const std::string ascii = escaped(text, [](char c) -> std::string_view {
    switch (c) {
      case '\\': return "\\textbackslash{}";
      case '{': return "\\{";
      case '}': return "\\}";
      case '$': return "\\$";
      case '&': return "\\&";
      case '#': return "\\#";
      case '%': return "\\%";
      case '_': return "\\_";
      case '^': return "\\textasciicircum{}";
      case '~': return "\\textasciitilde{}";
      case '<': return "\\textless{}";
      case '>': return "\\textgreater{}";
      case '"': return "\\textquotedbl{}";
      default: return {};
    }
  });
  std::string out;
  for (std::size_t i = 0; i < ascii.size();) {
    const std::string_view character = std::string_view(ascii).substr(i, bytes_of_character(ascii[i]));
    const std::string_view command = character.size() > 1 ? tex_of_character(character) : std::string_view();
    if (!command.empty()) out += fmt::format("${}$", command);
    else if (character.size() == 1 || is_set_by_tex(character)) out += character;
    else out += code_of(character);
    i += character.size();
  }
  return out;
}

std::optional<double> printed_number(std::string_view text) {
  if (text.empty() || text.find_first_not_of("0123456789+-.e") != std::string_view::npos) return std::nullopt;
  const std::string_view unsigned_text = text.substr(text.starts_with('+') && !text.starts_with("+-") ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(unsigned_text.data(), text.data() + text.size(), value);
  if (error == std::errc::invalid_argument || end != text.data() + text.size()) return std::nullopt;
  return error == std::errc() ? value : std::strtod(std::string(text).c_str(), nullptr);  // 0 or infinite
}

std::string tex_number(std::string_view printed) {
  const auto e = printed.find('e');
  if (!printed_number(printed)) return tex(printed);
  if (e == std::string_view::npos) return fmt::format(FMT_COMPILE("${}$"), printed);
  const auto mantissa = printed.substr(0, e), exponent = printed.substr(e + 1);
  if (mantissa == "1") return fmt::format(FMT_COMPILE("$10^{{{}}}$"), exponent);
  return fmt::format(FMT_COMPILE("${}\\times10^{{{}}}$"), mantissa, exponent);
}

std::string gnuplot(std::string_view text) {
  return "'" + escaped(text, [](char c) -> std::string_view { return c == '\'' ? "''" : ""; }) + "'";
}

std::string one_line(std::string_view text) {
  return escaped(text, [](char) -> std::string_view { return {}; });
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) -> unsigned {
      return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U;
    };
    const unsigned group = byte(0) << 16U | byte(1) << 8U | byte(2);
    out += alphabet[group >> 18U];
    out += alphabet[group >> 12U & 63U];
    out += i + 1 < bytes.size() ? alphabet[group >> 6U & 63U] : '=';
    out += i + 2 < bytes.size() ? alphabet[group & 63U] : '=';
  }
  return out;
}

std::size_t length(std::string_view utf8) {
  return static_cast<std::size_t>(
      std::count_if(utf8.begin(), utf8.end(), [](char c) { return !continues_character(c); }));
}

std::string shortened(std::string_view utf8, std::size_t characters) {
  if (length(utf8) <= characters) return std::string(utf8);
  std::size_t end = 0;
  for (std::size_t kept = 0; end < utf8.size(); ++end) {
    if (!continues_character(utf8[end]) && ++kept == characters) break;
  }
  return std::string(utf8.substr(0, end)) + "…";
}

}  // namespace polhode::study::text
