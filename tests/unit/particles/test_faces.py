"""Names of the faces, in pairs by axis."""

from lasersph.particles.faces import ENDS, PLANE, SURFACE, face_pairs, faces_of


def test_pairs_and_names_agree():
    """Every face belongs to one pair, at the end that ENDS says."""
    for dimension in (1, 2, 3):
        pairs = face_pairs(dimension)
        assert len(pairs) == dimension
        assert sorted(faces_of(dimension)) == sorted(face for pair in pairs for face in pair)
        for face in faces_of(dimension):
            axis, end = ENDS[face]
            assert pairs[axis][end] == face
    assert sorted(PLANE) == sorted(faces_of(2))
    assert faces_of(3)[0] == SURFACE
