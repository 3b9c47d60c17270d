// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/setting.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <type_traits>

#include "core/problem/catalogue.hpp"

namespace polhode::inline core::inline run {
namespace {

std::string text_of(double x) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, x).ptr};
}

std::string text_of(const SettingValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  if (const auto* number = std::get_if<double>(&value)) return text_of(*number);
  return std::get<std::string>(value);
}

}  // namespace

std::string Setting::words() const {
  std::string text = key;
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string Setting::range() const {
  std::string text;
  for (const std::string& choice : choices) text += (text.empty() ? "" : ", ") + choice;
  if (choices.empty()) text = text_of(lowest) + " to " + text_of(highest);
  return unit.empty() ? text : text + " " + unit;
}

std::string Setting::fault(const SettingValue& value) const {
  const auto allowed = [&]<class T>(const T& x) {
    if (!std::holds_alternative<T>(usual)) return false;
    if constexpr (std::is_same_v<T, std::string>) return std::find(choices.begin(), choices.end(), x) != choices.end();
    else return lowest <= static_cast<double>(x) && static_cast<double>(x) <= highest;
  };
  if (std::visit(allowed, value)) return {};
  return "has the " + words() + "s " + range() + ", not " + text_of(value);
}

const Setting* find_setting(const std::vector<Setting>& settings, std::string_view key) {
  return find_entry(settings, key, &Setting::key);
}

SettingValue value_of(const SettingValues& chosen, const Setting& setting) {
  const auto found = chosen.find(setting.key);
  if (found == chosen.end()) return setting.usual;
  if (std::string fault = setting.fault(found->second); !fault.empty())
    throw std::invalid_argument("the method " + fault);
  return found->second;
}

std::string settings_fault(const std::vector<Setting>& settings, const SettingValues& values) {
  for (const auto& [key, value] : values) {
    const Setting* setting = find_setting(settings, key);
    if (!setting) return "takes no " + key + "; leave it out";
    if (std::string fault = setting->fault(value); !fault.empty()) return fault;
  }
  return {};
}

}  // namespace polhode::core::run
