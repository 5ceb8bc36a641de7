"""A round spot whose surface moves: a quarter of it in 3-D beside its section (r, z)."""

from spot_pools import LIGHT, spot_case

from lasersph import run

SPACING = 8e-8
SPOT = {
    "spacing": SPACING,
    "depth": 8e-7,
    "material": "steel-304",
    "laser": LIGHT | {"beam": {"kind": "gaussian", "radius_1e2": 1.2e-6}},
    "time": {"end": 5e-8, "step": 2.5e-10},
}
FLOW = {"flow": {"surface": "moving"}, "vaporization": "flux"}


def spots(folder):
    """Summaries of the section and of the quarter."""
    section = spot_case(**SPOT, width=2e-6, solver=FLOW)
    block = {"depth": 8e-7, "width": 4e-6, "breadth": 4e-6, "extent": "quarter"}
    quarter = spot_case(**SPOT, domain=block, solver=FLOW | {"geometry": "planar", "dimensions": 3})
    return [
        run(case, folder / name, threads=1).summary
        for name, case in (("section", section), ("quarter", quarter))
    ]


def test_a_quarter_of_a_spot_is_its_section(tmp_path):
    """Volume and depth of the melt within 3 %: 2.3 and 0.3 % came out. Relief is made on both."""
    section, quarter = spots(tmp_path)
    found = {
        key: quarter[part][key] / section[part][key] - 1.0
        for part, key in (
            ("melt", "volume_max_m3"),
            ("melt", "depth_half_max_m"),
        )
    }
    assert abs(found["volume_max_m3"]) < 0.03, found
    assert abs(found["depth_half_max_m"]) < 0.03, found
    assert all(one["topography"]["center_m"] < -1e-8 for one in (section, quarter))
