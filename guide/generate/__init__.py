# SPDX-License-Identifier: BSD-3-Clause
"""What turns the sources of the guide, the catalogues and the READMEs into the pages of a book."""
