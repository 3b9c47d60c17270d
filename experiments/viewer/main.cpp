// SPDX-License-Identifier: BSD-3-Clause
// How does a scenario move? A window to watch it in.
int main() { return 0; }
