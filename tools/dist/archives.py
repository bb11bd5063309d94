"""Zip archives whose bytes depend on their content alone."""
import zipfile


def write_zip(path, members):
    """Writes `members`, a list of (name, bytes, whether it is a program), with one time and one mode for all."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content, is_program in members:
            member = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            member.create_system = 3
            member.compress_type, member.external_attr = zipfile.ZIP_DEFLATED, (0o755 if is_program else 0o644) << 16
            archive.writestr(member, content)
