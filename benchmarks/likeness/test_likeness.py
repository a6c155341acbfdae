# SPDX-License-Identifier: Apache-2.0
import math
import pathlib
import tempfile
import unittest

import likeness

NUM = len(likeness.TOLERANCES_M)


class KendallTauB(unittest.TestCase):
    def test_same_order_is_one_and_reversed_minus_one(self):
        self.assertEqual(likeness.kendall_tau_b([(1, 10), (2, 20), (5, 21)]), 1.0)
        self.assertEqual(likeness.kendall_tau_b([(1, 21), (2, 20), (5, 10)]), -1.0)

    def test_one_swap_of_four_items(self):
        # 5 concordant pairs, 1 discordant, of 6.
        self.assertAlmostEqual(likeness.kendall_tau_b([(1, 1), (2, 3), (3, 2), (4, 4)]), 4.0 / 6.0)

    def test_ties_leave_the_root_of_both_untied_counts(self):
        # Untied: 3 pairs in the first, 2 in the second, both concordant.
        self.assertAlmostEqual(likeness.kendall_tau_b([(1, 1), (2, 1), (3, 2)]), 2.0 / math.sqrt(6.0))

    def test_all_ties_have_no_order(self):
        self.assertIsNone(likeness.kendall_tau_b([(1, 1), (1, 2)]))


class Tables(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def reference(self):
        lines = ["pair,metric,setup,tolerance_m,value"]
        for setup, share in (("A", 0.5), ("B", 0.25)):
            lines += [f"0,repeatability,{setup},{m},{share}" for m in likeness.TOLERANCES_M]
            lines += [f"0,matches,{setup},{m},100" for m in likeness.TOLERANCES_M]
        lines += ["0,repeatability,C,0.04,-1"]
        return likeness.read_reference(self.write("reference.csv", "\n".join(lines)))

    def results(self):
        lines = ["lens,pair,metric,setup,tolerance_m,value"]
        for setup, share in (("A", 0.4), ("B", 0.3)):
            lines += [f"equisolid,0,repeatability,{setup},{m},{share}" for m in likeness.TOLERANCES_M]
            lines += [f"equidistant,0,repeatability,{setup},{m},0.9" for m in likeness.TOLERANCES_M]
        lines += ["equisolid,0,repeatability,A,,0.7",  # of an angle
                  "equisolid,0,repeatability,C,0.04,0.1",
                  "equisolid,0,detections_first,A,,310", "equisolid,0,detections_second,A,,250",
                  "equisolid,0,detections_first,B,,260", "equisolid,0,detections_second,B,,300"]
        return likeness.read_results(self.write("results.csv", "\n".join(lines)), "equisolid")

    def test_shares_are_compared_cell_by_cell(self):
        result = likeness.compare_shares("0", "repeatability", self.results(), self.reference())
        self.assertAlmostEqual(result.absolute, (0.1 + 0.05) / 2.0)
        self.assertAlmostEqual(result.signed, (-0.1 + 0.05) / 2.0)
        self.assertEqual(result.tau, 1.0)

    def test_a_pair_without_values_has_no_difference(self):
        result = likeness.compare_shares("24", "repeatability", self.results(), self.reference())
        self.assertEqual((result.absolute, result.signed, result.tau), (None, None, None))

    def test_detections_are_the_fewer_and_those_of_2014_follow_from_matches(self):
        counts = likeness.compare_detections("0", self.results(), self.reference())
        self.assertEqual([(c.setup, c.ours, c.theirs) for c in counts],
                         [("A", 250.0, 200.0), ("B", 260.0, 400.0), ("C", None, None)])
        self.assertEqual([c.is_near for c in counts], [True, False, False])

    def test_counts_agree_within_the_factor_both_ways(self):
        self.assertTrue(likeness.Count("A", 149.0, 100.0).is_near)
        self.assertFalse(likeness.Count("A", 151.0, 100.0).is_near)
        self.assertTrue(likeness.Count("A", 100.0, 149.0).is_near)
        self.assertFalse(likeness.Count("A", 100.0, 151.0).is_near)

    def test_the_tables_of_2014_are_complete(self):
        root = pathlib.Path(__file__).resolve().parents[2]
        theirs = likeness.read_reference(root / "data/reference/pfseq_2014_features.csv")
        self.assertEqual(round(likeness.reference_detections(theirs, "0", "SIFT nopol 0.02 20.0 1.6")), 16979)
        self.assertEqual(len({setup for (_, metric, setup) in theirs if metric == "repeatability"}), 12)
        self.assertEqual(len({setup for (_, metric, setup) in theirs if metric == "matching_score"}), 18)

    def test_missing_files_and_columns_are_told(self):
        with self.assertRaisesRegex(likeness.InputError, "none.csv: No such file"):
            likeness.read_reference(self.folder / "none.csv")
        with self.assertRaisesRegex(likeness.InputError, "results.csv: expected a column setup, got lens, pair"):
            likeness.read_results(self.write("results.csv", "lens,pair,metric\n0,1,2\n"), "equisolid")


if __name__ == "__main__":
    unittest.main()
