// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/where.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cctype>
#include <charconv>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <utility>

#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/legible.hpp"

namespace polhode::study::inline plan {

/// Recursive descent with a bounded depth. Each function emits the instructions of what it reads, and returns whether
/// that is a value or a truth.
class WhereParser {
 public:
  WhereParser(std::string_view text, Where& where) : text_(text), where_(where) {}

  void run() {
    next();
    const Kind kind = disjunction();
    if (!token_.empty()) fail(start_, "'" + shortened(token_) + "' is not expected here");
    truth(kind, 0);
  }

 private:
  using Code = Where::Code;
  enum class Kind { value, truth };

  [[noreturn]] void fail(std::size_t at, const std::string& what) const {
    throw InputError(fmt::format("{}: character {}: {}; a condition is as in dt < 0.1 and not (integrator == 'rk4')",
                                 where_.label_, at + 1, what));
  }
  void truth(Kind kind, std::size_t at) const {
    if (kind != Kind::truth) fail(at, "a comparison is expected here, not a value");
  }
  void value(Kind kind, std::size_t at) const {
    if (kind != Kind::value) fail(at, "a value is expected here, not a comparison");
  }
  void emit(Code code, std::size_t index = 0, double number = 0) { where_.program_.push_back({code, number, index}); }

  static bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.'; }

  /// Reads the next token: a number, a word, a quoted text with its quotes, or signs; empty at the end.
  void next() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    start_ = at_;
    if (at_ == text_.size()) return void(token_ = {});
    const char c = text_[at_];
    if (c == '\'' || c == '"') {
      const std::size_t end = text_.find(c, at_ + 1);
      if (end == std::string_view::npos) fail(at_, "a quote is opened and never closed");
      at_ = end + 1;
    } else if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') {
      const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), number_);
      if (error != std::errc()) fail(at_, "a number that no double can hold");
      at_ = static_cast<std::size_t>(end - text_.data());
      if (at_ < text_.size() && is_word(text_[at_])) fail(start_, "a number ends in a letter");
    } else if (is_word(c)) {
      while (at_ < text_.size() && is_word(text_[at_])) ++at_;
    } else {
      at_ += std::string_view("<>=!").find(c) != std::string_view::npos && text_.substr(at_ + 1, 1) == "=" ? 2 : 1;
    }
    token_ = text_.substr(start_, at_ - start_);
  }
  bool take(std::string_view token) {
    if (token_ != token) return false;
    next();
    return true;
  }
  void expect(std::string_view token) {
    if (!take(token)) fail(start_, fmt::format("'{}' is missing", token));
  }

  /// { operand (word operand) }, both of truth.
  template <class Operand>
  Kind chain(std::string_view word, Code code, const Operand& operand) {
    const std::size_t at = start_;
    Kind kind = operand();
    while (token_ == word) {
      truth(kind, at);
      next();
      const std::size_t second = start_;
      truth(operand(), second);
      emit(code);
    }
    return kind;
  }
  Kind disjunction() {
    return chain("or", Code::disjunction, [&] { return conjunction(); });
  }
  Kind conjunction() {
    return chain("and", Code::conjunction, [&] { return negation(); });
  }
  Kind negation() {
    if (token_ != "not") return comparison();
    const Deeper deeper(*this);
    next();
    const std::size_t at = start_;
    truth(negation(), at);
    emit(Code::negation);
    return Kind::truth;
  }

  static constexpr std::pair<std::string_view, Code> relations[] = {{"<", Code::less},    {"<=", Code::less_equal},
                                                                    {">", Code::greater}, {">=", Code::greater_equal},
                                                                    {"==", Code::equal},  {"!=", Code::unequal}};

  Kind comparison() {
    const std::size_t at = start_;
    const Kind kind = sum();
    const auto relation_here = [&] {
      return std::find_if(std::begin(relations), std::end(relations), [&](const auto& r) { return r.first == token_; });
    };
    const auto relation = relation_here();
    if (token_ == "=") fail(start_, "'=' compares nothing; write ==");
    if (relation == std::end(relations)) return kind;
    value(kind, at);
    next();
    const std::size_t second = start_;
    value(sum(), second);
    emit(relation->second);
    if (relation_here() != std::end(relations)) fail(start_, "a second comparison in a row; join them by and");
    return Kind::truth;
  }

  /// { operand (sign operand) }, all values.
  template <class Operand>
  Kind arithmetic(std::initializer_list<std::pair<std::string_view, Code>> signs, const Operand& operand) {
    const std::size_t at = start_;
    const Kind kind = operand();
    for (;;) {
      const auto sign = std::find_if(signs.begin(), signs.end(), [&](const auto& s) { return s.first == token_; });
      if (sign == signs.end()) return kind;
      value(kind, at);
      next();
      const std::size_t second = start_;
      value(operand(), second);
      emit(sign->second);
    }
  }
  Kind sum() {
    return arithmetic({{"+", Code::add}, {"-", Code::subtract}}, [&] { return product(); });
  }
  Kind product() {
    return arithmetic({{"*", Code::multiply}, {"/", Code::divide}}, [&] { return factor(); });
  }

  Kind factor() {
    const Deeper deeper(*this);
    const std::size_t at = start_;
    if (take("-")) {
      value(factor(), at);
      emit(Code::negate);
      return Kind::value;
    }
    if (take("(")) {
      const Kind kind = disjunction();
      expect(")");
      return kind;
    }
    if (token_.empty()) fail(at, "the condition ends too early");
    const char c = token_.front();
    if (c == '\'' || c == '"') return text(token_.substr(1, token_.size() - 2));
    if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') {
      emit(Code::number, 0, number_);
      next();
      return Kind::value;
    }
    if (!is_word(c) || token_ == "and" || token_ == "or" || token_ == "not")
      fail(at, "a number, a 'text' or a key is expected here, not '" + shortened(token_) + "'");
    if (token_ == "true" || token_ == "false") return text(token_);
    const std::string_view name = token_;
    next();
    return token_ == "(" ? call(name, at) : key(name);
  }

  Kind text(std::string_view content) {
    where_.texts_.emplace_back(content);
    emit(Code::text, where_.texts_.size() - 1);
    next();
    return Kind::value;
  }
  std::size_t index_of(std::string_view name) {
    auto& keys = where_.keys_;
    const auto found = std::find(keys.begin(), keys.end(), name);
    if (found != keys.end()) return static_cast<std::size_t>(found - keys.begin());
    keys.emplace_back(name);
    return keys.size() - 1;
  }
  Kind key(std::string_view name) {
    emit(Code::key, index_of(name));
    return Kind::value;
  }

  Kind call(std::string_view name, std::size_t at) {
    expect("(");
    if (name == "given") {
      emit(Code::given, index_of(token_));
      next();
      expect(")");
      return Kind::truth;
    }
    std::size_t arguments = 0;
    do {
      const std::size_t argument = start_;
      value(sum(), argument);
      ++arguments;
    } while (take(","));
    expect(")");
    if (name == "abs" && arguments == 1) emit(Code::magnitude);
    else if (name == "min") emit(Code::minimum, arguments);
    else if (name == "max") emit(Code::maximum, arguments);
    else
      fail(at,
           "there is no function '" + shortened(name) + "' of that many arguments; there are min, max, abs and given");
    return Kind::value;
  }

  /// Counts how deep brackets, not and - are nested.
  struct Deeper {
    explicit Deeper(WhereParser& p) : parser(p) {
      if (++parser.depth_ > most_nested) parser.fail(parser.start_, "it is nested more than 100 deep");
    }
    ~Deeper() { --parser.depth_; }
    Deeper(const Deeper&) = delete;
    Deeper& operator=(const Deeper&) = delete;
    WhereParser& parser;
  };
  static constexpr int most_nested = 100;

  std::string_view text_;
  Where& where_;
  std::size_t at_ = 0, start_ = 0;
  std::string_view token_;
  double number_ = 0;
  int depth_ = 0;
};

Where::Where(std::string_view text, std::string label) : label_(std::move(label)) { WhereParser(text, *this).run(); }

namespace {

struct Absent {};
using Operand = std::variant<Absent, double, std::string_view, bool>;

/// Operands of the stack machine; the texts outlive it.
class OperandStack {
 public:
  explicit OperandStack(const std::string& label) : label_(label) {}

  void push(Operand operand) { operands_.push_back(operand); }
  Operand pop() {
    const Operand top = operands_.back();
    operands_.pop_back();
    return top;
  }
  bool pop_truth() { return std::get<bool>(pop()); }

  template <class Operation>
  void truths(const Operation& operation) {
    const bool b = pop_truth(), a = pop_truth();
    push(operation(a, b));
  }

  /// An operation on two numbers; absent if one of them is.
  template <class Operation>
  void numbers(const Operation& operation) {
    const Operand b = pop(), a = pop();
    if (std::holds_alternative<Absent>(a) || std::holds_alternative<Absent>(b)) return push(Absent{});
    push(operation(number(a), number(b)));
  }

  template <class Relation>
  void compare(const Relation& relation) {
    const Operand b = pop(), a = pop();
    if (std::holds_alternative<Absent>(a) || std::holds_alternative<Absent>(b)) return push(false);
    if (a.index() != b.index()) fail(fmt::format("it compares {} with {}", shown(a), shown(b)));
    if (std::holds_alternative<double>(a)) push(relation(std::get<double>(a), std::get<double>(b)));
    else push(relation(std::get<std::string_view>(a), std::get<std::string_view>(b)));
  }

 private:
  double number(const Operand& operand) const {
    if (const double* x = std::get_if<double>(&operand)) return *x;
    fail("it calculates with the text " + shown(operand));
  }
  static std::string shown(const Operand& operand) {
    if (const double* x = std::get_if<double>(&operand)) return fmt::format("the number {}", *x);
    return "'" + shortened(std::get<std::string_view>(operand)) + "'";
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(label_ + ": " + what + "; numbers compare with numbers, texts with 'texts'");
  }

  const std::string& label_;
  boost::container::small_vector<Operand, 16> operands_;  // most conditions need no more
};

}  // namespace

bool Where::holds(std::span<const WhereValue> values) const {
  OperandStack stack(label_);
  const auto value = [&](std::size_t i) -> Operand {
    if (const double* x = std::get_if<double>(&values[i])) return *x;
    if (const auto* text = std::get_if<std::string_view>(&values[i])) return *text;
    return Absent{};
  };
  const auto least = [](double a, double b) { return std::min(a, b); };
  const auto most = [](double a, double b) { return std::max(a, b); };
  for (const Instruction& instruction : program_) {
    switch (instruction.code) {
      case Code::number: stack.push(instruction.number); break;
      case Code::text: stack.push(std::string_view(texts_[instruction.index])); break;
      case Code::key: stack.push(value(instruction.index)); break;
      case Code::given: stack.push(!std::holds_alternative<std::monostate>(values[instruction.index])); break;
      case Code::add: stack.numbers(std::plus<>()); break;
      case Code::subtract: stack.numbers(std::minus<>()); break;
      case Code::multiply: stack.numbers(std::multiplies<>()); break;
      case Code::divide: stack.numbers(std::divides<>()); break;
      case Code::negate:
        stack.push(-1.0);
        stack.numbers(std::multiplies<>());
        break;
      case Code::magnitude:
        stack.push(0.0);
        stack.numbers([](double x, double) { return std::abs(x); });
        break;
      case Code::minimum:
        for (std::size_t i = 1; i < instruction.index; ++i) stack.numbers(least);
        break;
      case Code::maximum:
        for (std::size_t i = 1; i < instruction.index; ++i) stack.numbers(most);
        break;
      case Code::less: stack.compare(std::less<>()); break;
      case Code::less_equal: stack.compare(std::less_equal<>()); break;
      case Code::greater: stack.compare(std::greater<>()); break;
      case Code::greater_equal: stack.compare(std::greater_equal<>()); break;
      case Code::equal: stack.compare(std::equal_to<>()); break;
      case Code::unequal: stack.compare(std::not_equal_to<>()); break;
      case Code::conjunction: stack.truths(std::logical_and<>()); break;
      case Code::disjunction: stack.truths(std::logical_or<>()); break;
      case Code::negation: stack.push(!stack.pop_truth()); break;
    }
  }
  return stack.pop_truth();
}

}  // namespace polhode::study::plan
