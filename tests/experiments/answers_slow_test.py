# SPDX-License-Identifier: BSD-3-Clause
"""The answers of 200 random studies, counted again from runs.csv."""
import unittest

from answer_test import Answers


class ManyAnswers(Answers):
    seed, studies = 77, 200


del Answers  # else its tests run here too

if __name__ == "__main__":
    unittest.main()
