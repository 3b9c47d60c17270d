// SPDX-License-Identifier: BSD-3-Clause
// Style sheet of report.html: system fonts, light and dark colour schemes, one column that fits a phone, a print
// layout.
#pragma once

#include <string_view>

namespace polhode::study::inline report::inline page {

inline constexpr std::string_view page_style = R"css(
:root {
  color-scheme: light dark;
  --paper: #ffffff; --ink: #1d2126; --soft: #59616b; --rule: #d9dde2; --panel: #f4f6f8; --accent: #0b62a4;
  --warn: #fff4e0; --warn-rule: #d98a00; --edge: rgba(0, 0, 0, .22);
}
@media (prefers-color-scheme: dark) {
  :root {
    --paper: #16191d; --ink: #e4e7ea; --soft: #a3abb5; --rule: #363c44; --panel: #1f2429; --accent: #7cbcf0;
    --warn: #33291a; --warn-rule: #d98a00; --edge: rgba(255, 255, 255, .3);
  }
}
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body {
  margin: 0 auto; padding: 2rem 1.25rem 4rem; max-width: 64rem; background: var(--paper); color: var(--ink);
  font: 1rem/1.55
    system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", "Noto Sans", "DejaVu Sans", sans-serif;
}
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .4rem; }
h2 {
  font-size: 1.35rem; line-height: 1.3; margin: 2.8rem 0 .8rem; padding-top: .8rem;
  border-top: 1px solid var(--rule);
}
h3 { font-size: 1.08rem; margin: 1.6rem 0 .4rem; }
p, ul, dl { margin: .5rem 0; }
ul { padding-left: 1.3rem; }
li { margin: .3rem 0; overflow-wrap: anywhere; }
a { color: var(--accent); }
.question { font-size: 1.15rem; color: var(--soft); margin: 0 0 1rem; }
.answer { margin: .35rem 0; }
.answer.first { font-size: 1.12rem; font-weight: 600; }
#answer { margin-top: 1.2rem; }
#answer .wide { margin: .5rem 0; }
.spoken { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
#answer figure { margin: .6rem 0 1rem; }
.outcome { font-weight: 600; }
nav ul { list-style: none; display: flex; flex-wrap: wrap; gap: .3rem 1.2rem; padding: 0; margin: 1rem 0 0; }
.caution {
  background: var(--warn); border-left: 4px solid var(--warn-rule);
  padding: .7rem 1rem; margin: 1rem 0; overflow-wrap: anywhere;
}
.caution strong { display: block; }
.box { background: var(--panel); border-radius: 6px; padding: .8rem 1.1rem 1rem; margin: 1.6rem 0; }
.box summary { font-weight: 600; margin: .2rem 0; }
.box dl { display: grid; grid-template-columns: 9.5rem 1fr; gap: .35rem 1rem; font-size: .94rem; }
.box dt, .box dd { margin: 0; }
dt { font-weight: 600; margin-top: .6rem; }
dd { margin: 0 0 0 1.2rem; overflow-wrap: anywhere; }
pre {
  background: var(--panel); padding: .8rem 1rem; border-radius: 6px;
  overflow-x: auto; white-space: pre-wrap; overflow-wrap: anywhere;
}
code, pre, .name {
  font-family: ui-monospace, SFMono-Regular, Menlo, Consolas, "DejaVu Sans Mono", monospace; font-size: .88em;
}
figure { margin: 1.6rem 0 2.2rem; }
.drawing { border: 1px solid var(--rule); border-radius: 6px; padding: .5rem; overflow-x: auto; }
.drawing img { display: block; margin: 0 auto; max-width: 100%; height: auto; }
@media (max-width: 44rem) { .drawing img { max-width: none; } }
/* A shadow at the right edge where there is more to the right. */
.wide, .drawing {
  background:
    linear-gradient(to left, var(--behind) 50%, transparent) right -2px top / 2rem 100% no-repeat local,
    linear-gradient(to left, var(--edge), transparent) right / .7rem 100% no-repeat scroll, var(--behind);
}
.wide { --behind: var(--paper); }
.drawing { --behind: #ffffff; --edge: rgba(0, 0, 0, .22); }
.scene { display: block; width: 100%; height: auto; }
.start { display: flex; flex-wrap: wrap; gap: .4rem 1.6rem; align-items: flex-start; }
.start figure { flex: 1 1 20rem; max-width: 34rem; margin: .4rem 0; }
.start ul { flex: 1 1 18rem; font-size: .94rem; }
figcaption { font-size: .93rem; color: var(--soft); margin-top: .5rem; }
figcaption b { color: var(--ink); }
.wide { overflow-x: auto; margin: .8rem 0 1.2rem; }
table { border-collapse: collapse; font-size: .86rem; line-height: 1.35; }
caption { text-align: left; color: var(--soft); padding: 0 0 .4rem; }
.caption { display: inline-block; position: sticky; left: 0; max-width: calc(100vw - 2.5rem); }
th, td { text-align: left; vertical-align: top; padding: .3rem .6rem; border-bottom: 1px solid var(--rule); }
thead th { border-bottom: 2px solid var(--rule); vertical-align: bottom; }
tbody th { font-weight: 400; position: sticky; left: 0; background: var(--paper); }
.number { text-align: right; font-variant-numeric: tabular-nums; }
td.number, .name, .short, .nowrap { white-space: nowrap; }
td.text { min-width: 14rem; }
.none, .tie { color: var(--soft); }
summary { cursor: pointer; margin: .8rem 0; }
#seen > details > summary { font-weight: 600; }
footer { margin-top: 3rem; color: var(--soft); font-size: .88rem; }
@media screen and (min-width: 64rem) {  /* a table may be wider than the text, to the edges of the window */
  .wide {
    width: min-content; min-width: 100%; max-width: calc(100vw - 3rem); position: relative; left: 50%;
    transform: translateX(-50%);
  }
}
@media (max-width: 40rem) {
  body { padding: 1.2rem .9rem 3rem; }
  h1 { font-size: 1.55rem; }
  .box dl { display: block; }
  .box dt { margin-top: .5rem; }
  th, td { padding: .3rem .5rem; }
}
@media print {
  :root { --paper: #fff; --ink: #000; --soft: #444; --rule: #bbb; --panel: #f4f4f4; --accent: #000; --warn: #fff; }
  html { font-size: 10pt; }
  body { max-width: none; padding: 0; }
  nav { display: none; }
  figure, .caution, .box { break-inside: avoid; }
  h2, h3 { break-after: avoid; }
  .wide, .drawing { overflow: visible; background: none; }
  .drawing { border: 0; padding: 0; }
  table { font-size: 7.5pt; }
  th, td { padding: .15rem .3rem; }
  tbody th { position: static; }
}
)css";

}  // namespace polhode::study::report::page
