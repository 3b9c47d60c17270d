// SPDX-License-Identifier: BSD-3-Clause
// A picture in gnuplot's words, in fewer. tests/experiments/report_page_test.py compares what is drawn.
#include "experiments/study/report/page/compact_svg.hpp"

#include <gtest/gtest.h>

#include <string>

namespace polhode::study::compact_svg_test {
namespace {

/// A picture as gnuplot writes it, with that content.
std::string picture(const std::string& content) {
  return "<?xml version=\"1.0\" encoding=\"utf-8\"  standalone=\"no\"?>\n<svg \n width=\"643\" height=\"420\"\n "
         "viewBox=\"0 0 "
         "643 420\"\n xmlns=\"http://www.w3.org/2000/svg\"\n xmlns:xlink=\"http://www.w3.org/1999/xlink\"\n>\n\n"
         "<title>a</title>\n<desc>Produced by GNUPLOT 5.4 patchlevel 4 </desc>\n<g id=\"gnuplot_canvas\">\n<defs>\n"
         "\t<circle id='gpPt5' stroke-width='0.222' stroke='currentColor' cx='0' cy='0' r='1'/>\n"
         "\t<use xlink:href='#gpPt5' id='gpPt6' fill='currentColor' stroke='none'/>\n"
         "\t<circle id='gpDot' r='0.5' stroke-width='0.5' stroke='currentColor'/>\n"
         "\t<filter id='textbox' x='0'>\n\t  <feFlood result='bgnd'/>\n\t</filter>\n</defs>\n" +
         content + "</g>\n</svg>\n";
}

/// The text that remains of it between the definitions and the end.
std::string drawn(const std::string& content) {
  const std::string all = compact_svg(picture(content));
  const auto start = all.find("</defs>") + 7;
  return all.substr(start, all.rfind("</svg>") - start);
}

const std::string group =
    "<g fill=\"none\" color=\"black\" stroke=\"currentColor\" stroke-width=\"1.00\" stroke-linecap=\"butt\" "
    "stroke-linejoin=\"miter\">\n";

TEST(CompactSvg, LeavesOutWhatIsNotDrawn) {
  EXPECT_EQ(compact_svg(picture("<!-- nothing -->" + group + "</g>\n")),
            "<svg xmlns='http://www.w3.org/2000/svg' width='643' height='420' viewBox='0 0 643 420'><style></style>"
            "<defs></defs></svg>");
}

TEST(CompactSvg, WritesPathsAsDifferencesWithTheirStyleOnce) {
  const std::string all = compact_svg(picture(group +
                                              "\t<path stroke='rgb( 51,  51,  51)' class=\"gridline\" d='M86.06,65.01 "
                                              "L86.06,295.00\n\t\tL249.69,295.00 Z  '/></g>\n"
                                              "<g color=\"red\">" +
                                              group + "<path d='M1.00,2.00 L0.50,2.25  '/></g></g>" + group +
                                              "<path stroke-dasharray='2,4' d='M0,0 L1,0'/></g>"));
  EXPECT_NE(all.find("<style>.a{fill:none;stroke:#333}.b{fill:none;stroke:black}.c{fill:none;stroke:black;"
                     "stroke-dasharray:2,4}</style>"),
            std::string::npos)
      << all;
  EXPECT_NE(all.find("<path class='a' d='m86.06,65.01,0,229.99,163.63,0z'/><path class='b' d='m1,2-.5,.25'/><path "
                     "class='c' d='m0,0,1,0'/>"),
            std::string::npos)
      << all;
}

TEST(CompactSvg, JoinsPathsOfOneStyleThatFollowEachOther) {
  const std::string line = group + "<path d='M1,2 L3,4'/></g>\n";
  EXPECT_EQ(drawn(line + line), "<path class='a' d='m1,2,2,2m-2-2,2,2'/>");
  // After the end of a closed line the pen is where it began.
  EXPECT_EQ(drawn(group + "<path d='M1,1 L5,1 Z M2,2 L3,2'/></g>"), "<path class='a' d='m1,1,4,0zm1,1,1,0'/>");
}

TEST(CompactSvg, MakesTheMarkersOfACurveOnePath) {
  const auto marker = [](const std::string& at, const std::string& colour) {
    return "<use xlink:href='#gpPt6' transform='translate(" + at + ") scale(3.87)' color='" + colour + "'/>\n";
  };
  const std::string all =
      compact_svg(picture(group + marker("135.15,335.26", "rgb(  0, 158, 115)") +
                          marker("140.15,330.00", "rgb(  0, 158, 115)") + marker("1,2", "red") + "</g>"));
  EXPECT_NE(all.find("<path class='a' d='m135.15,335.26,5-5.26'/><path class='b' d='m1,2,0,0'/></svg>"),
            std::string::npos)
      << all;
  EXPECT_NE(all.find(".a{fill:none;marker:url(#m0)}.b{fill:none;marker-start:url(#m1)}"), std::string::npos) << all;
  EXPECT_NE(all.find("<marker id='m0' overflow='visible' markerUnits='userSpaceOnUse'><use href='#gpPt6' "
                     "transform='scale(3.87)' fill='none' color='#009e73'/></marker>"),
            std::string::npos)
      << all;
  EXPECT_NE(all.find("id='gpPt5'"), std::string::npos);  // gpPt6 is made of it
  EXPECT_EQ(all.find("gpDot"), std::string::npos);
}

TEST(CompactSvg, KeepsTheWordsAndWhereTheyStand) {
  const auto text = [](const std::string& transform, const std::string& words) {
    return "<g transform=\"" + transform +
           "\" stroke=\"none\" fill=\"rgb(51,51,51)\" font-family=\"sans-serif\" font-size=\"12.00\"  "
           "text-anchor=\"end\">\n\t\t<text>" +
           words + "</text>\n\t</g>\n";
  };
  const std::string look = "<style>.a{fill:#333;font-family:sans-serif;font-size:12px;text-anchor:end}</style>";
  const std::string power =
      "<tspan font-family=\"sans-serif\" >−10</tspan><tspan font-family=\"sans-serif\"  font-size=\"9.6\" "
      "dy=\"-6.00px\">-4</tspan><tspan font-size=\"12.0\" dy=\"6.00\"></tspan>";
  const std::string all = compact_svg(picture(group + text("translate(77.67,199.70)", power) + "</g>"));
  EXPECT_NE(all.find(look), std::string::npos) << all;
  EXPECT_NE(all.find("<text class='a' x='77.67' y='199.7'>−10<tspan dy='-6.00px' font-size='9.6'>-4</tspan></text>"),
            std::string::npos)
      << all;
  EXPECT_EQ(drawn(text("translate(24.32,180.01) rotate(270)", "a &lt; b")),
            "<text class='a' transform='translate(24.32,180.01) rotate(270)'>a &lt; b</text>");
}

TEST(CompactSvg, KeepsTheBoxBehindWords) {
  const auto words = [](const std::string& style) {
    return "<g transform=\"translate(1.00,2.00)\" fill=\"red\" " + style + "><text>rk4</text></g>";
  };
  const std::string all = compact_svg(picture(words("style='filter:url(#textbox)'") + words("")));
  EXPECT_NE(
      all.find("<style>.a{fill:red;filter:url(#textbox)}.b{fill:red}</style><defs><filter id='textbox' x='0'>"
               "<feFlood result='bgnd'/></filter></defs><text class='a' x='1' y='2'>rk4</text><text class='b' x='1' "
               "y='2'>rk4</text></svg>"),
      std::string::npos)
      << all;
  const std::string other = picture(words("style='opacity:0.5'"));
  EXPECT_EQ(compact_svg(other), other);
}

TEST(CompactSvg, DrawsCellsOfAMap) {
  const std::string cell =
      "<g stroke='none' shape-rendering='crispEdges'>\n<polygon fill = 'rgb(255,   0,   1)' points = ";
  EXPECT_EQ(drawn(cell + "'1.00,2.00 3.00,2.00 3.00,5.25 '/>\n</g>\n" + cell + "'3,2 5,2 5,5.25'/></g>"),
            "<path class='a' d='m1,2,2,0,0,3.25zm2,0,2,0,0,3.25z'/>");
}

TEST(CompactSvg, LeavesAPictureAloneThatHoldsSomethingElse) {
  for (const std::string content :
       {"<image width='1'/>", "<g opacity='0.5'><path d='M1,2'/></g>", "<path d='M1,2 C3,4'/>", "<path d='L1,2'/>",
        "<g filter='url(#textbox)'></g>", "<use xlink:href='#none' transform='translate(1,2) scale(1)'/>",
        "<use xlink:href='#gpPt6' transform='rotate(1)'/>", "<g>", "words", "<path d='M1,2' d>",
        "<path stroke='&lt;' d='M1,2'/>"}) {
    EXPECT_EQ(compact_svg(picture(content)), picture(content));
  }
  EXPECT_EQ(compact_svg(""), "");
  EXPECT_EQ(compact_svg("no picture"), "no picture");
}

TEST(SvgAddress, EscapesWhatAnAddressOrAnAttributeCannotHold) {
  EXPECT_EQ(svg_address("<a b='#1' c=\"2\">\n5% & −</a>"),
            "data:image/svg+xml,%3ca%20b='%231'%20c=%222%22%3e%0a5%25%20%26%20%e2%88%92%3c/a%3e");
}

}  // namespace
}  // namespace polhode::study::compact_svg_test
