// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/text_hash.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <new>

namespace polhode::study::inline text {
namespace {

std::string in_digits(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

}  // namespace

std::uint64_t text_number(std::string_view text) { return XXH3_64bits(text.data(), text.size()); }

std::string text_hash(std::string_view text) { return in_digits(text_number(text)); }

TextHash::TextHash() : state_(XXH3_createState()) {
  if (!state_) throw std::bad_alloc();
  XXH3_64bits_reset(state_.get());
}

void TextHash::add(std::string_view part) { XXH3_64bits_update(state_.get(), part.data(), part.size()); }

std::string TextHash::text() const { return in_digits(XXH3_64bits_digest(state_.get())); }

void TextHash::Free::operator()(XXH3_state_s* state) const { XXH3_freeState(state); }

}  // namespace polhode::study::text
