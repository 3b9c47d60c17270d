// SPDX-License-Identifier: BSD-3-Clause
// Conditions on the cells of a study: "dt < 0.1 * body.0.inertia.1 and not (integrator == 'rk4' or t_end > 10)".
//
//   condition = all { "or" all }            all = not { "and" not }             not = "not" not | comparison
//   comparison = sum [ relation sum ]   relation = < <= > >= == !=
//   sum = product { (+|-) product }         product = factor { (*|/) factor }
//   factor = - factor | number | 'text' | true | false | KEY | (condition) | min(…) | max(…) | abs(…) | given(KEY)
//
// A key is an option (dt, t_end, integrator) or a key of the scenario (body.0.mass). A comparison with a key that a
// cell does not have is false, != too; given(KEY) is true if the cell has it.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace polhode::study::inline plan {

/// The value of a key in a cell; std::monostate: the cell does not have it. The text is held elsewhere.
using WhereValue = std::variant<std::monostate, double, std::string_view>;

class Where {
 public:
  /// Throws InputError, which begins with the label and names the character at fault.
  Where(std::string_view text, std::string label);

  const std::string& label() const { return label_; }
  const std::vector<std::string>& keys() const { return keys_; }  ///< each once, in the order of the text

  /// True if the condition holds for the values of keys(). Throws InputError if it compares a number with a text.
  bool holds(std::span<const WhereValue> values) const;

 private:
  friend class WhereParser;

  enum class Code {
    number,
    text,
    key,
    add,
    subtract,
    multiply,
    divide,
    negate,
    less,
    less_equal,
    greater,
    greater_equal,
    equal,
    unequal,
    conjunction,
    disjunction,
    negation,
    minimum,
    maximum,
    magnitude,
    given
  };
  /// An instruction of a stack machine: the condition in postfix order, so that evaluation needs no recursion.
  struct Instruction {
    Code code;
    double number = 0;
    std::size_t index = 0;  ///< index of a key or a text; number of arguments of min and max
  };
  std::string label_;
  std::vector<Instruction> program_;
  std::vector<std::string> keys_, texts_;
};

}  // namespace polhode::study::plan
