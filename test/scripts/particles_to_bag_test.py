#!/usr/bin/env python3
"""particles_to_bag: every format, what it refuses, and ids that it makes."""
import fractions
import sys

import numpy as np

import particle_file_writers as writers
from script_support import PROJECT, ScriptTest, clouds_of, main

PROGRAM = PROJECT / "scripts/particles_to_bag"


def frame(count=20, step=0, seed=1):
    """Particles with all that a frame can have. Every step they move by the same, and are shuffled."""
    random = np.random.default_rng(seed)
    fields = {"position": random.random((count, 3)).astype(np.float32), "velocity": random.random((count, 3)).astype(np.float32),
              "id": (7 * np.arange(count)).astype(np.int32), "density": random.random(count).astype(np.float32)}
    fields["position"][:, 0] += np.float32(0.01 * step)
    order = np.random.default_rng(100 + step).permutation(count)
    return {name: values[order] for name, values in fields.items()}


FORMATS = {
    "ply": writers.write_ply,
    "text.ply": lambda path, fields: writers.write_ply(path, fields, binary=False),
    "vtk": writers.write_vtk,
    "text.vtk": lambda path, fields: writers.write_vtk(path, fields, binary=False),
    "vtu": writers.write_vtk,
    "text.vtu": lambda path, fields: writers.write_vtk(path, fields, binary=False),
    "vtp": writers.write_vtk,
    "csv": writers.write_csv,
    "spaces.txt": lambda path, fields: writers.write_csv(path, fields, separator=" "),
    "npz": writers.write_npz,
    "text.pcd": lambda path, fields: writers.write_pcd(path, fields, "ascii"),
    "pcd": writers.write_pcd,
    "packed.pcd": lambda path, fields: writers.write_pcd(path, fields, "binary_compressed"),
    "bgeo": writers.write_bgeo,
    "plain.bgeo": lambda path, fields: writers.write_bgeo(path, fields, compressed=False),
    "bgeo.gz": writers.write_bgeo,
}


class Case(ScriptTest):
    def convert(self, *arguments, exit_code=0):
        return self.run_script(PROGRAM, "--bag", self.folder / "out.bag", *arguments, exit_code=exit_code)

    def clouds(self):
        return clouds_of(self.folder / "out.bag")

    def refused(self, *arguments, parts, exit_code=2):
        _, errors = self.convert(*arguments, exit_code=exit_code)
        self.assert_one_line(errors, *parts)
        self.assertEqual(list(self.folder.glob("*.bag")) + list(self.folder.glob(".*")), [])


class Formats(Case):
    def test_every_format_gives_the_same_clouds(self):
        for name, write in FORMATS.items():
            with self.subTest(name):
                paths = [self.folder / f"frame_{step}.{name}" for step in range(2)]
                for step, path in enumerate(paths):
                    write(path, frame(step=step))
                self.convert(*paths)
                clouds = self.clouds()
                self.assertEqual(len(clouds), 2)
                for step, (_, points, _) in enumerate(clouds):
                    # VTK writes six digits as text.
                    self.assert_points(points, frame(step=step), tolerance=1e-5 if name == "text.vtk" else 0)

    def assert_points(self, points, fields, tolerance):
        self.assertEqual(points.dtype.names, ("x", "y", "z", "id", "vx", "vy", "vz", "density"))
        np.testing.assert_array_equal(points["id"], fields["id"])
        for axis, name in enumerate("xyz"):
            np.testing.assert_allclose(points[name], fields["position"][:, axis], rtol=tolerance)
            np.testing.assert_allclose(points["v" + name], fields["velocity"][:, axis], rtol=tolerance)
        np.testing.assert_allclose(points["density"].astype(np.float32), fields["density"], rtol=tolerance)

    def test_types_are_those_of_a_particle_cloud(self):
        writers.write_npz(self.folder / "a.npz", {**frame(), "kind": np.arange(20), "large": 2**40 + np.arange(20),
                                                  "solid": np.arange(20) > 4})
        self.convert(self.folder / "a.npz")
        message, points, _ = self.clouds()[0]
        self.assertEqual([str(points.dtype[name]) for name in ("x", "y", "z", "id")], ["float32"] * 3 + ["uint32"])
        self.assertEqual([field.offset for field in message.fields[:4]], [0, 4, 8, 12])
        self.assertEqual([str(points.dtype[name]) for name in ("kind", "large", "solid")], ["uint32", "float64", "uint8"])
        np.testing.assert_array_equal(points["large"], 2**40 + np.arange(20))
        self.assertEqual((message.height, message.width, message.row_step), (1, 20, 20 * message.point_step))
        self.assertEqual(message.row_step, len(message.data))
        self.assertFalse(message.is_bigendian)

    def test_vectors_in_columns_are_found_as_paraview_names_them(self):
        (self.folder / "a.csv").write_text('"Points:0","Points:1","Points:2","velocity:0","velocity:1","velocity:2","Id"\n'
                                           '1,2,3,4,5,6,7\n')
        self.convert(self.folder / "a.csv")
        self.assertEqual(self.clouds()[0][1].tolist(), [(1.0, 2.0, 3.0, 7, 4.0, 5.0, 6.0)])

    def test_one_file_may_hold_all_frames(self):
        positions = np.random.default_rng(1).random((3, 5, 3))
        np.savez(self.folder / "all.npz", position=positions, id=np.arange(5))
        self.convert(self.folder / "all.npz")
        for step, (_, points, _) in enumerate(self.clouds()):
            np.testing.assert_array_equal(points["y"], positions[step, :, 1].astype(np.float32))
        self.assertEqual(step, 2)

    def test_what_a_cloud_cannot_carry_is_said(self):
        writers.write_npz(self.folder / "a.npz", {**frame(), "stress": np.zeros((20, 6))})
        output, _ = self.convert(self.folder / "a.npz")
        self.assertIn("stress", output)


class Sequences(Case):
    def test_files_are_taken_in_the_order_of_their_numbers(self):
        for step in (2, 10, 1):
            writers.write_csv(self.folder / f"Fluid_{step}.csv", frame(step=step))
        self.convert(self.folder)
        self.assertEqual([points["x"].tolist() for _, points, _ in self.clouds()],
                         [frame(step=step)["position"][:, 0].tolist() for step in (1, 2, 10)])

    def test_record_time_is_the_stamp_to_the_nanosecond(self):
        for step in range(4):
            writers.write_npz(self.folder / f"{step}.npz", frame(step=step))
        self.convert(self.folder, "--frame-rate", "24000/1001", "--start-time", "7", "--frame-id", "tank")
        clouds = self.clouds()
        for step, (message, _, time) in enumerate(clouds):
            self.assertEqual(time, message.header.stamp)
            exact = 7 * 10**9 + fractions.Fraction(step * 1001 * 10**9, 24000)
            self.assertEqual(time.to_nsec(), round(exact))
            self.assertEqual((message.header.frame_id, message.header.seq), ("tank", step))
        self.assertEqual(step, 3)

    def test_numbers_of_particles_may_differ(self):
        for step, count in enumerate((20, 0, 30)):
            writers.write_npz(self.folder / f"{step}.npz", frame(count))
        output, _ = self.convert(self.folder)
        self.assertEqual([message.width for message, _, _ in self.clouds()], [20, 0, 30])
        self.assertIn("3 frames of 0 to 30 particles", output)

    def test_the_same_files_give_the_same_bytes(self):
        writers.write_npz(self.folder / "a.npz", frame())
        contents = []
        for _ in range(2):
            self.run_program(sys.executable, PROGRAM, "--bag", self.folder / "out.bag", self.folder / "a.npz")
            contents.append((self.folder / "out.bag").read_bytes())
        self.assertEqual(*contents)


class BadInput(Case):
    def test_files_that_are_cut_off(self):
        for name, write in FORMATS.items():
            with self.subTest(name):
                path = self.folder / f"frame.{name}"
                write(path, frame(200))
                whole = path.read_bytes()
                path.write_bytes(whole[:int(0.6 * len(whole)) + 1])
                if name in ("csv", "spaces.txt"):  # A table does not say how long it is; half a line is seen.
                    path.write_bytes(path.read_bytes().rstrip(b"\n").rsplit(b"," if name == "csv" else b" ", 2)[0])
                self.refused(path, parts=[str(path)])
                path.unlink()

    def test_empty_files_and_files_of_another_format(self):
        for name in FORMATS:
            for content in (b"", b"\x00\x01 neither this nor that\n" * 20):
                with self.subTest(name, content=content[:4]):
                    path = self.folder / f"frame.{name}"
                    path.write_bytes(content)
                    self.refused(path, parts=[str(path)])
                    path.unlink()

    def test_libraries_print_nothing_of_their_own(self):
        for name in ("vtk", "vtu", "text.ply"):
            path = self.folder / f"frame.{name}"
            FORMATS[name](path, frame())
            path.write_bytes(path.read_bytes()[:-300])
            _, errors = self.run_program(sys.executable, PROGRAM, "--bag", self.folder / "out.bag", path, exit_code=2)
            self.assert_one_line(errors, str(path))

    def test_numbers_that_are_not_finite(self):
        for name in ("position", "velocity"):
            fields = frame()
            fields[name][3, 1] = np.nan
            writers.write_npz(self.folder / "a.npz", fields)
            self.refused(self.folder / "a.npz", parts=["a.npz", "1 of 20", "not finite", "row 3"])

    def test_positions_that_float32_does_not_hold(self):
        writers.write_npz(self.folder / "a.npz", {**frame(), "position": np.full((20, 3), 1e300)})
        self.refused(self.folder / "a.npz", parts=["a.npz", "FLOAT32"])

    def test_files_without_ids(self):
        fields = frame()
        fields["number"] = fields.pop("id")
        writers.write_npz(self.folder / "a.npz", fields)
        self.refused(self.folder / "a.npz", parts=["a.npz", "no ids", "--id-field", "--match-nearest"])
        self.convert(self.folder / "a.npz", "--id-field", "number")
        np.testing.assert_array_equal(self.clouds()[0][1]["id"], fields["number"])

    def test_one_frame_without_ids(self):
        for step in range(2):
            fields = frame(step=step)
            if step == 1:
                del fields["id"]
            writers.write_npz(self.folder / f"{step}.npz", fields)
        self.refused(self.folder, parts=["1.npz", "no ids"])

    def test_ids_that_are_none(self):
        for values, part in ((np.zeros(20, int), "id 0 occurs more than once"), (np.arange(20) - 1, "-1"),
                             (np.arange(20) + 2**32, "4294967315"), (np.arange(20) + 0.5, "0.5"),
                             (2 * np.arange(20, dtype=np.float32) + np.float32(2**24), "16777216"), (np.full(20, np.nan), "finite"),
                             (np.zeros((20, 2), int), "no single numbers")):
            with self.subTest(part):
                writers.write_npz(self.folder / "a.npz", {**frame(), "id": values})
                self.refused(self.folder / "a.npz", parts=["a.npz", part])

    def test_an_id_field_that_is_not_there(self):
        writers.write_npz(self.folder / "a.npz", frame())
        self.refused(self.folder / "a.npz", "--id-field", "number", parts=["'number'", "density"])

    def test_fields_of_different_lengths(self):
        writers.write_npz(self.folder / "a.npz", {**frame(), "density": np.zeros(19)})
        self.refused(self.folder / "a.npz", parts=["'density' has 19 rows", "20"])

    def test_half_a_velocity_is_not_passed_on(self):
        (self.folder / "a.csv").write_text("x,y,z,id,vx\n1,2,3,4,5\n")
        output, _ = self.convert(self.folder / "a.csv")
        self.assertEqual(self.clouds()[0][1].dtype.names, ("x", "y", "z", "id"))
        self.assertIn("vx", output)

    def test_files_that_are_not_there_or_not_known(self):
        self.refused(self.folder / "none.ply", parts=["none.ply", "No such file"])
        (self.folder / "a.abc").touch()
        self.refused(self.folder / "a.abc", parts=["a.abc", ".bgeo"])
        self.refused(self.folder, parts=[str(self.folder), "no particle files"])

    def test_a_bag_that_cannot_be_written(self):
        writers.write_npz(self.folder / "a.npz", frame())
        _, errors = self.run_program(sys.executable, PROGRAM, "--bag", self.folder / "none/out.bag", self.folder / "a.npz", exit_code=4)
        self.assert_one_line(errors, "none/out.bag")

    def test_wrong_usage(self):
        writers.write_npz(self.folder / "a.npz", frame())
        for arguments in (["--frame-rate", "0"], ["--frame-rate", "fast"], ["--start-time", "0"], ["--no-such-option"],
                          ["--match-nearest", "--id-field", "id"], ["--spacing", "0.1"]):
            with self.subTest(arguments):
                self.refused(self.folder / "a.npz", *arguments, parts=["particles_to_bag"], exit_code=1)

    def test_a_bag_that_is_there_stays_when_the_run_fails(self):
        (self.folder / "out.bag").write_bytes(b"old")
        (self.folder / "a.csv").write_text("x,y,z,id\n1,2,3,4\nnan,2,3,5\n")
        self.convert(self.folder / "a.csv", exit_code=2)
        self.assertEqual((self.folder / "out.bag").read_bytes(), b"old")


def lattice(side=8, spacing=0.1):
    return spacing * np.stack(np.meshgrid(*[np.arange(side)] * 3, indexing="ij"), -1).reshape(-1, 3)


class Matching(Case):
    def write(self, frames):
        """Every frame shuffled, with the true number of each particle beside it."""
        for step, fields in enumerate(frames):
            order = np.random.default_rng(step).permutation(len(fields["position"]))
            writers.write_npz(self.folder / f"{step}.npz", {name: values[order] for name, values in fields.items()})

    def followed(self):
        """For every frame the true numbers by id."""
        return [dict(zip(points["id"].tolist(), points["number"].tolist())) for _, points, _ in self.clouds()]

    def test_bodies_that_move_by_more_than_the_spacing(self):
        left, right = lattice(), lattice(6) + [2.0, 0, 0]
        numbers = np.arange(len(left) + len(right))
        self.write({"position": np.concatenate([left + [0.13 * step, 0, 0], right - [0.11 * step, 0.1 * step, 0]]),
                    "number": numbers} for step in range(4))
        output, _ = self.convert(self.folder, "--match-nearest")
        first, *others = self.followed()
        for other in others:
            self.assertEqual(other, first)
        self.assertIn("0.00 % of the particles unmatched", output)

    def test_velocities_are_used(self):
        # Without them a layer that begins to slide by a spacing looks as if it had not moved.
        body = lattice(6)
        velocity = np.where(body[:, 2:] > 0.25, [[6.0, 0, 0]], 0.0)
        self.write({"position": body + velocity * step / 60, "velocity": velocity, "number": np.arange(len(body))}
                   for step in range(3))
        self.convert(self.folder, "--match-nearest")
        first, *others = self.followed()
        for other in others:
            self.assertEqual(other, first)

    def test_what_comes_and_goes_has_ids_of_its_own(self):
        body = lattice(5)
        numbers = np.arange(125)
        self.write([{"position": body, "number": numbers}, {"position": body[:100], "number": numbers[:100]},
                    {"position": body, "number": np.concatenate([numbers[:100], 200 + numbers[100:]])}])
        output, _ = self.convert(self.folder, "--match-nearest")
        first, second, third = self.followed()
        self.assertTrue(second.items() <= first.items())
        self.assertEqual({id for id, number in third.items() if number >= 200}, set(range(125, 150)))
        self.assertIn("11.11 % in the worst frame", output)  # 25 of 225

    def test_unsure_matches_are_counted(self):
        body = lattice(6)
        jitter = np.random.default_rng(3).normal(size=body.shape) * 0.035
        self.write([{"position": body, "number": np.arange(216)}, {"position": body + jitter, "number": np.arange(216)}])
        output, _ = self.convert(self.folder, "--match-nearest")
        first, second = self.followed()
        wrong = sum(second[id] != first.get(id) for id in second)
        ambiguous = float(output.split("%")[2].split()[-1]) / 100 * 216
        self.assertGreater(ambiguous, wrong)
        self.assertGreater(wrong, 0)

    def test_frames_that_have_nothing_in_common_are_refused(self):
        random = np.random.default_rng(5)
        self.write({"position": lattice() + 100 * step * random.random(3)} for step in range(3))
        self.refused(self.folder, "--match-nearest", "--spacing", "0.001", parts=["1.npz", "not found again"])

    def test_a_spacing_that_is_not_theirs_is_warned_of(self):
        self.write({"position": lattice() + [0.01 * step, 0, 0]} for step in range(3))
        for spacing in ("0.03", "0.3"):
            output, errors = self.convert(self.folder, "--match-nearest", "--spacing", spacing)
            self.assert_one_line(errors, "warning", f"--spacing is {spacing} m", "0.1 m")
            self.assertIn(f"spacing r = {spacing} m, as given", output)
        _, errors = self.convert(self.folder, "--match-nearest", "--spacing", "0.12", "--quiet")
        self.assertEqual(errors, "")

    def test_the_spacing_for_the_next_command_is_said(self):
        self.write({"position": lattice() + [0.01 * step, 0, 0]} for step in range(3))
        output, errors = self.convert(self.folder, "--match-nearest")
        self.assertIn("spacing r = 0.1 m, estimated from the first frame", output)
        self.assertEqual(errors, "")

    def test_more_unmatched_particles_than_detail_stands_are_warned_of(self):
        body = lattice()
        self.write({"position": body[5 * step:] + [0.01 * step, 0, 0]} for step in range(3))
        _, errors = self.convert(self.folder, "--match-nearest")
        self.assertEqual(errors, "")
        self.write({"position": body[20 * step:] + [0.01 * step, 0, 0]} for step in range(3))
        _, errors = self.convert(self.folder, "--match-nearest", "--quiet")
        self.assert_one_line(errors, "warning", "unmatched", "above about 1 %", "detail")

    def test_one_particle_has_no_spacing(self):
        self.write({"position": np.full((1, 3), 0.001 * step)} for step in range(2))
        self.refused(self.folder, "--match-nearest", parts=["0.npz", "--spacing"])
        self.convert(self.folder, "--match-nearest", "--spacing", "0.1")
        self.assertEqual([points["id"].tolist() for _, points, _ in self.clouds()], [[0], [0]])


if __name__ == "__main__":
    main()
