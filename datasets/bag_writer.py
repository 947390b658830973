"""`BagWriter`: writes ROS messages into one ``.mcap`` (ROS 2) or ``.bag`` (ROS 1) file."""

import shutil
import tempfile
from contextlib import AbstractContextManager
from pathlib import Path
from types import TracebackType
from typing import Any

from rosbags import rosbag1, rosbag2
from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from ial.errors import OutputError

_FOREVER = QosTime(2147483647, 4294967295)
_LATCHED = Qos(
    QosHistory.KEEP_LAST,
    1,
    QosReliability.RELIABLE,
    QosDurability.TRANSIENT_LOCAL,
    _FOREVER,
    _FOREVER,
    QosLiveliness.AUTOMATIC,
    _FOREVER,
    False,
)
_LARGEST_SECONDS = 2**31 - 1


class BagWriter(AbstractContextManager["BagWriter"]):
    """An open bag to write to; the file appears under its name when the block ends without an error.

    Parameters
    ----------
    path
        Ends in ``.mcap`` or ``.bag``; a file of that name is replaced.

    Raises
    ------
    OutputError
        If the name ends otherwise or the file cannot be written.
    """

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        if self.path.suffix not in (".mcap", ".bag"):
            raise OutputError(f"{self.path}: the name must end in .mcap (ROS 2) or .bag (ROS 1)")
        self._is_ros1 = self.path.suffix == ".bag"
        self._store = get_typestore(Stores.ROS1_NOETIC if self._is_ros1 else Stores.ROS2_JAZZY)
        if self._is_ros1:
            self._store.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", "tf2_msgs/msg/TFMessage"))
        self._connections: dict[str, Any] = {}
        try:
            self._folder = Path(tempfile.mkdtemp(prefix=f".{self.path.stem}-", dir=self.path.parent))
        except OSError as error:
            raise OutputError(f"{self.path}: cannot be written ({error.strerror or error}); choose another folder") from None
        inner = self._folder / "recording"
        self._writer: Any
        if self._is_ros1:
            self._writer = rosbag1.Writer(inner)
        else:
            self._writer = rosbag2.Writer(inner, version=9, storage_plugin=rosbag2.StoragePlugin.MCAP)
        self._writer.open()

    def message(self, kind: str, **fields: Any) -> Any:
        """Return a message of a type such as ``nav_msgs/msg/Odometry`` from its fields."""
        return self._store.types[kind](**fields)

    def header(self, stamp_ns: int, frame: str) -> Any:
        """Return a std_msgs/Header.

        Raises
        ------
        OutputError
            If a header cannot hold the stamp.
        """
        if not 0 <= stamp_ns // 10**9 <= _LARGEST_SECONDS:
            raise OutputError(f"{self.path}: a stamp of {stamp_ns} ns cannot be written: headers hold 0 to 2³¹ − 1 seconds")
        stamp = self.message("builtin_interfaces/msg/Time", sec=stamp_ns // 10**9, nanosec=stamp_ns % 10**9)
        sequence = {"seq": 0} if self._is_ros1 else {}
        return self.message("std_msgs/msg/Header", stamp=stamp, frame_id=frame, **sequence)

    def write(self, topic: str, kind: str, stamp_ns: int, message: Any, latched: bool = False) -> None:
        """Write a message.

        Parameters
        ----------
        topic, kind
            Its topic and type.
        stamp_ns
            When it was received, as the bag says.
        message
            The message.
        latched
            Late subscribers get it too (``/tf_static``, maps).
        """
        if topic not in self._connections:
            if self._is_ros1:
                how: dict[str, Any] = {"latching": int(latched)}
            else:
                how = {"offered_qos_profiles": [_LATCHED] if latched else []}
            self._connections[topic] = self._writer.add_connection(topic, kind, typestore=self._store, **how)
        serialize = self._store.serialize_ros1 if self._is_ros1 else self._store.serialize_cdr
        try:
            self._writer.write(self._connections[topic], stamp_ns, serialize(message, kind))
        except OSError as error:
            raise OutputError(f"{self.path}: cannot be written ({error.strerror or error}); is the disk full?") from None

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        try:
            self._writer.__exit__(kind, error, trace)
            if kind is None:
                inner = self._folder / "recording"
                (inner if self._is_ros1 else next(inner.glob("*.mcap"))).replace(self.path)
        except OSError as fault:
            raise OutputError(f"{self.path}: cannot be written ({fault.strerror or fault}); is the disk full?") from None
        finally:
            shutil.rmtree(self._folder, ignore_errors=True)
