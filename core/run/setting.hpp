// SPDX-License-Identifier: BSD-3-Clause
// A setting of a method: a value that its user may choose, as data with meaning, unit and range.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace polhode::inline core::inline run {

/// A whole number, a number, or one of several names.
using SettingValue = std::variant<std::int64_t, double, std::string>;

/// One setting of a method. Methods may share a key; its type, meaning and unit are then the same in all of them.
struct Setting {
  std::string key;                     ///< a noun in the singular, '_' between words: "order"
  SettingValue usual;                  ///< value if the user chooses none; its type is the type of the setting
  std::string meaning;                 ///< words that follow the key: "of methods that offer several"
  std::string unit{};                  ///< unit of a number as it is printed: "s"; empty: none
  double lowest = 0, highest = 0;      ///< range of a number; lowest > 0
  std::vector<std::string> choices{};  ///< the names

  std::string words() const;                           ///< the key as words: "time scale" for time_scale
  std::string range() const;                           ///< "2 to 8", "0.1 to 2 s" or "first, second"
  std::string fault(const SettingValue& value) const;  ///< "has the orders 2 to 8, not 9"; empty: the value is allowed
};

/// Values that a user has chosen, by key.
using SettingValues = std::map<std::string, SettingValue>;

/// The setting with this key, or null.
const Setting* find_setting(const std::vector<Setting>& settings, std::string_view key);

/// The chosen value of the setting, or the usual one. Throws std::invalid_argument if it is not allowed.
SettingValue value_of(const SettingValues& chosen, const Setting& setting);

/// The reason why a method with these settings does not take the values: "takes no order; leave it out"; empty: it
/// does.
std::string settings_fault(const std::vector<Setting>& settings, const SettingValues& values);

}  // namespace polhode::core::run
