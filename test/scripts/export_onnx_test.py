#!/usr/bin/python3
"""scripts/export_onnx as a person sees it: what it reads, and what it says of what it can't read."""

import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(HERE), str(ROOT / "scripts")]
sys.dont_write_bytecode = True

import random_networks as networks  # noqa: E402
import torch_file  # noqa: E402
from make_tiny_network import tiny_network  # noqa: E402
from onnx_export import checkpoint, export  # noqa: E402
from onnx_export.errors import ExportError  # noqa: E402

WRITERS = (torch_file.write_legacy, torch_file.write_zip)


class ExportTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)
        self.given = self.path / "given.pth"
        self.made = self.path / "made.onnx"

    def refusal(self, *parts):
        """The error for self.given, which has to hold the parts; nothing may be left behind."""
        with self.assertRaises(ExportError) as caught:
            export.export(self.given, self.made)
        message = str(caught.exception)
        self.assertNotIn("\n", message)
        for part in parts:
            self.assertIn(part, message)
        self.assertEqual([p.name for p in self.path.iterdir()], ["given.pth"])
        return message


class Reading(ExportTest):
    def test_both_formats_give_the_tensors_back(self):
        arrays = networks.e2vid(3)
        arrays["half"] = np.array([[0.5, -2.0]], np.float16)
        arrays["double"] = np.array([1.25], np.float64)
        for write in WRITERS:
            write(self.given, arrays, epoch=7)
            read = checkpoint.read_weights(self.given)
            self.assertEqual(read.keys(), arrays.keys())
            for name, array in arrays.items():
                np.testing.assert_array_equal(read[name], array)

    def test_both_formats_give_the_same_file(self):
        made = []
        for write in WRITERS:
            write(self.given, networks.firenet(3))
            self.assertEqual(export.export(self.given, self.made), "FireNet")
            made.append(self.made.read_bytes())
        self.assertEqual(made[0], made[1])

    def test_long_and_short_names_mean_the_same_network(self):
        made = []
        for make in (networks.firenet, networks.firenet_by_long_names):
            made.append(export.build_model(make(3)).SerializeToString(deterministic=True))
        self.assertEqual(made[0], made[1])

    def test_names_of_a_network_trained_on_several_devices(self):
        arrays = networks.firenet(3)
        torch_file.write_zip(self.given, {"module." + name: array for name, array in arrays.items()})
        self.assertEqual(checkpoint.read_weights(self.given).keys(), arrays.keys())

    def test_the_settings_of_a_training_are_read_over(self):
        for write in WRITERS:
            write(self.given, networks.firenet(3), config=torch_file.Call("parse_config", "ConfigParser", "x"))
            self.assertEqual(export.export(self.given, self.made), "FireNet")

    def test_the_committed_model_is_what_comes_out(self):
        made = export.build_model(tiny_network()).SerializeToString(deterministic=True)
        self.assertEqual(made, (ROOT / "test" / "models" / "tiny_network.onnx").read_bytes())


class Refusing(ExportTest):
    def test_no_checkpoint(self):
        for content in (b"", b"hello", b"\x80\x02K\x01.", bytes(1000), b"PK\x03\x04 and no more"):
            self.given.write_bytes(content)
            self.refusal()

    def test_truncated_anywhere(self):
        for write in WRITERS:
            write(self.given, networks.firenet(3))
            whole = self.given.read_bytes()
            for part in np.linspace(0, len(whole) - 1, 60).astype(int):
                self.given.write_bytes(whole[:part])
                self.refusal()
            self.given.write_bytes(whole[:-100])
            self.refusal("truncated")

    def test_damaged_anywhere(self):
        random = np.random.default_rng(5)
        for write in WRITERS:
            write(self.given, networks.firenet(3, channels=2))
            whole = bytearray(self.given.read_bytes())
            for _ in range(300):
                damaged = bytearray(whole)
                for place in random.integers(0, len(whole), random.integers(1, 9)):
                    damaged[place] = random.integers(0, 256)
                self.given.write_bytes(damaged)
                try:
                    export.build_model(checkpoint.read_weights(self.given))  # what was hit may be of no account
                except ExportError as error:
                    self.assertNotIn("\n", str(error))

    def test_nothing_is_executed(self):
        victim = self.path / "victim"
        for write in WRITERS:
            for module, name in (("os", "system"), ("builtins", "eval"), ("torch", "load"), ("subprocess", "Popen")):
                write(self.given, networks.firenet(3), hook=torch_file.Call(module, name, f"touch {victim}"))
                self.refusal(f"{module}.{name}")
        self.assertFalse(victim.exists())

    def test_unknown_architecture_lists_what_is_there(self):
        torch_file.write_legacy(self.given, {f"layer{i}.weight": np.zeros(1, np.float32) for i in range(9)})
        self.refusal("FireNet", "E2VID", "layer0.weight", "and 3 more")

    def test_a_tensor_is_missing(self):
        for make, name in ((networks.firenet, "G2.out_gate.bias"),
                           (networks.e2vid, "unetrecurrent.encoders.1.recurrent_block.Gates.weight"),
                           (networks.e2vid, "unetrecurrent.resblocks.0.bn2.running_var")):
            arrays = make(3)
            del arrays[name]
            torch_file.write_zip(self.given, arrays)
            self.refusal("missing")

    def test_wrong_shapes(self):
        wrong = {"G1.reset_gate.weight": (6, 11, 3, 3), "pred.conv2d.weight": (2, 6, 1, 1), "R2.conv1.bias": (5,),
                 "head.conv2d.weight": (6, 5, 3), "R1.conv1.weight": (6, 6, 2, 2), "G2.out_gate.weight": (6, 12, 3, 5)}
        for name, shape in wrong.items():
            torch_file.write_zip(self.given, {**networks.firenet(3), name: np.ones(shape, np.float32)})
            self.refusal(name)

    def test_an_e2vid_whose_halves_differ(self):
        arrays = {k: v for k, v in networks.e2vid(3).items() if ".decoders.2." not in k}
        torch_file.write_zip(self.given, arrays)
        self.refusal("3 encoders and 2 decoders")

    def test_values_that_are_not_finite(self):
        arrays = networks.firenet(3)
        arrays["R1.conv1.weight"][0, 0, 0, 0] = np.nan
        torch_file.write_zip(self.given, arrays)
        self.refusal("R1.conv1.weight", "not finite")

    def test_a_tensor_that_reaches_beyond_its_storage(self):
        torch_file.write_zip(self.given, networks.firenet(3))
        with zipfile.ZipFile(self.given) as archive:
            members = {info.filename: archive.read(info) for info in archive.infolist()}
        members["archive/data/1000"] = members["archive/data/1000"][:-4]
        with zipfile.ZipFile(self.given, "w") as archive:
            for name, content in members.items():
                archive.writestr(name, content)
        self.refusal("too few")

    def test_strides_cannot_reach_other_memory(self):
        flat = np.zeros(4, np.float32)
        key = checkpoint.Tensor(None, 0, (2, 2), (2, 1))
        self.assertEqual(key.array(flat).shape, (2, 2))
        for offset, shape, strides in ((1, (2, 2), (2, 1)), (0, (2, 2), (3, 1)), (-1, (1,), (1,)), (0, (2,), (-1,)),
                                       (0, (1 << 40,), (0,)), (0, (2, 2), (1,))):
            with self.assertRaises(ExportError):
                checkpoint.Tensor(None, offset, shape, strides).array(flat)


class CommandLine(ExportTest):
    def run_script(self, *arguments):
        command = [str(ROOT / "scripts" / "export_onnx"), *map(str, arguments)]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def test_success(self):
        torch_file.write_zip(self.given, networks.e2vid(3))
        run = self.run_script(self.given, self.made)
        self.assertEqual((run.returncode, run.stdout), (0, ""))
        self.assertIn("E2VID", run.stderr)
        self.assertEqual(sorted(p.name for p in self.path.iterdir()), ["given.pth", "made.onnx"])

    def test_errors_are_one_line(self):
        self.given.write_bytes(b"hello")
        absent = self.path / "absent" / "made.onnx"
        good = self.path / "good.pth"
        torch_file.write_zip(good, networks.firenet(3))
        for arguments in ((self.given, self.made), (self.path / "none", self.made), (good, absent), (good, good),
                          (good, self.path), (self.path, self.made)):
            run = self.run_script(*arguments)
            self.assertEqual(run.returncode, 1, arguments)
            self.assertRegex(run.stderr, r"\Aexport_onnx: [^\n]+\n\Z")
        self.assertEqual(sorted(p.name for p in self.path.iterdir()), ["given.pth", "good.pth"])


if __name__ == "__main__":
    unittest.main()
