"""Collects the shared libraries that programs need beyond those of a bare glibc system, and their licences."""
import os
import pathlib
import shutil
import subprocess

TRIPLETS = {"amd64": "x86_64-linux-gnu", "arm64": "aarch64-linux-gnu", "armhf": "arm-linux-gnueabihf"}
# glibc is every system's own: its parts have to be of one version.
OF_THE_SYSTEM = ("ld-linux", "libc.so", "libm.so", "libdl.so", "libpthread.so", "librt.so", "libresolv.so", "libutil.so",
                 "libnss_", "libanl.so", "libmvec.so")


class Bundle:
    """Libraries of one architecture, found where Debian keeps them: on this system or in a sysroot."""

    def __init__(self, arch):
        self.root = pathlib.Path(os.environ.get("LAMELLA_SYSROOT") or "/")
        self.folders = [self.root / "lib" / TRIPLETS[arch], self.root / "usr/lib" / TRIPLETS[arch]]
        self.libraries = {}  # name: path

    def need(self, program):
        """Adds all that `program` needs, and what that needs."""
        listed = subprocess.run(["patchelf", "--print-needed", program], check=True, capture_output=True, text=True)
        for name in listed.stdout.split():
            if name.startswith(OF_THE_SYSTEM) or name in self.libraries:
                continue
            found = [folder / name for folder in self.folders if (folder / name).exists()]
            if not found:
                raise SystemExit(f"{program}: the library {name} is not found")
            self.libraries[name] = found[0].resolve()
            self.need(self.libraries[name])

    def copy_to(self, folder, runpath="$ORIGIN"):
        folder.mkdir(parents=True, exist_ok=True)
        for name, path in sorted(self.libraries.items()):
            shutil.copyfile(path, folder / name)
            (folder / name).chmod(0o755)
            set_runpath(folder / name, runpath)

    def copy_licences_to(self, folder):
        """One file a Debian package whose library is here: its copyright and licences."""
        owners = self._owners()
        for name, path in self.libraries.items():
            places = [path.as_posix(), path.as_posix().removeprefix("/usr")]
            package = next((owners[place] for place in places if place in owners), None)
            if not package:
                raise SystemExit(f"{path}: belongs to no package, so its licence is not known")
            folder.mkdir(parents=True, exist_ok=True)
            text = (self.root / "usr/share/doc" / package / "copyright").read_bytes()
            (folder / f"{package}.txt").write_bytes(text)

    def _owners(self):
        info = pathlib.Path(os.environ.get("LAMELLA_ADMIN") or "/var/lib/dpkg") / "info"
        owners = {}
        for listed in info.glob("*.list"):
            for line in listed.read_text(encoding="utf-8").splitlines():
                if ".so" in line:
                    owners[line] = listed.stem.split(":")[0]
        return owners


def set_runpath(file, runpath):
    subprocess.run(["patchelf", "--set-rpath", runpath, file], check=True)
