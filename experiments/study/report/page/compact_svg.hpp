// SPDX-License-Identifier: BSD-3-Clause
// A picture of gnuplot in fewer bytes: what the page holds. The file beside the page stays as gnuplot wrote it.
#pragma once

#include <string>
#include <string_view>

namespace polhode::study::inline report::inline page {

/// The same picture without a word that is not drawn. Styles become classes, the markers of a curve one path,
/// coordinates differences. A picture that holds anything which is not known here comes back as it is.
std::string compact_svg(const std::string& svg);

/// The picture as an address for the src of an image: whatever an address or an attribute cannot hold is escaped.
std::string svg_address(std::string_view svg);

}  // namespace polhode::study::report::page
