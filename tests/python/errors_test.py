"""Errors of files are also those that Python has for them."""

import os
import pickle

import pytest

import kinemend


def test_a_missing_file_is_a_file_not_found_error(noisy, tmp_path):
    missing = tmp_path / "nowhere.bvh"
    model = tmp_path / "nowhere.kmodel"
    for use in (kinemend.read, kinemend.clean, kinemend.check, kinemend.fill, kinemend.contacts, kinemend.from_npz,
                lambda path: kinemend.compare(noisy, path), lambda path: kinemend.train("example", [path]),
                lambda path: kinemend.LiveFilter(path), lambda path: kinemend.corrupt(path, "gaussian")):
        with pytest.raises(FileNotFoundError) as raised:
            use(missing)
        error = raised.value
        assert isinstance(error, kinemend.Error) and error.kind == "unreadable_input"
        assert error.file == error.filename == str(missing) and str(error) == f"{missing}: No such file or directory"
    with pytest.raises(FileNotFoundError):
        kinemend.cleaners.wiener(model=model)
    with pytest.raises(FileNotFoundError) as raised:
        kinemend.write(noisy, tmp_path / "no_folder" / "a.bvh")
    assert raised.value.kind == "cannot_write"


def test_an_output_that_exists_is_a_file_exists_error(noisy, tmp_path):
    kinemend.write(noisy, tmp_path / "a.bvh")
    with pytest.raises(FileExistsError, match="overwrite=True"):
        kinemend.write(noisy, tmp_path / "a.bvh")


def test_a_folder_is_an_is_a_directory_error(tmp_path):
    with pytest.raises(IsADirectoryError):
        kinemend.read(tmp_path)


def test_a_file_that_may_not_be_read_is_a_permission_error(tmp_path):
    from kinemend._errors import error_of

    error = error_of("walk.bvh: Permission denied", "unreadable_input")
    assert isinstance(error, PermissionError) and isinstance(error, kinemend.Error)
    if os.geteuid() == 0:
        pytest.skip("root may read every file")
    (tmp_path / "walk.bvh").write_text("")
    (tmp_path / "walk.bvh").chmod(0)
    with pytest.raises(PermissionError):
        kinemend.read(tmp_path / "walk.bvh")


def test_what_a_file_holds_is_no_error_of_the_system(tmp_path):
    (tmp_path / "a.bvh").write_text("no take")
    with pytest.raises(kinemend.Error) as raised:
        kinemend.read(tmp_path / "a.bvh")
    assert not isinstance(raised.value, OSError)
    # Bytes have a name but no file.
    with pytest.raises(kinemend.Error) as raised:
        kinemend.read(b"no take", name="nowhere.bvh")
    assert not isinstance(raised.value, OSError)


def test_errors_keep_their_class_when_pickled(tmp_path):
    with pytest.raises(FileNotFoundError) as raised:
        kinemend.read(tmp_path / "nowhere.bvh")
    again = pickle.loads(pickle.dumps(raised.value))
    assert type(again) is type(raised.value) and str(again) == str(raised.value) and again.file == raised.value.file
