"""`BagFile`: topics and messages of a ROS 1 or ROS 2 bag, with rosbags' many errors turned into one that says what to do."""

import logging
import struct
from collections import Counter
from collections.abc import Collection, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from types import TracebackType
from typing import Any

from rosbags import rosbag1, rosbag2
from rosbags.interfaces import MessageDefinitionFormat
from rosbags.typesys import Stores, TypesysError, get_types_from_idl, get_types_from_msg, get_typestore

from ial.datasets.info import Topic
from ial.errors import RecordingError

logger = logging.getLogger("ial.datasets")

ROS1_MAGIC = b"#ROSBAG V2.0"
SQLITE_MAGIC = b"SQLite format 3\x00"
MCAP_MAGIC = b"\x89MCAP0\r\n"
_IDL_RULE = "=" * 80 + "\n"


class BagFile(AbstractContextManager["BagFile"]):
    """An open bag: a ROS 1 ``.bag``, a ROS 2 folder, or a bare ``.db3`` or ``.mcap``, recognized by its first bytes.

    Only the definitions of the messages that are asked for are looked at, so a bag with odd types on other topics can be read. Where a bag
    holds no definitions, as those of ROS 2 before Iron in SQLite do not, the ones of ROS 2 Jazzy are taken.

    Parameters
    ----------
    path
        The file or folder.

    Raises
    ------
    RecordingError
        If it is no bag, truncated, damaged, or without an index.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._is_ros1 = False
        with self._trouble():
            self._reader = self._choose_reader()
            self._reader.open()
        self._default = get_typestore(Stores.ROS1_NOETIC if self._is_ros1 else Stores.ROS2_JAZZY)
        self._types = get_typestore(Stores.EMPTY)

    def _choose_reader(self) -> Any:
        if self.path.is_dir():
            for file in self.path.iterdir():
                _check_complete(file)
            return rosbag2.Reader(self.path)
        with self.path.open("rb") as stream:
            head = stream.read(16)
        _check_complete(self.path)
        if head.startswith(ROS1_MAGIC):
            self._is_ros1 = True
            return rosbag1.Reader(self.path)
        plugin = ".db3" if head == SQLITE_MAGIC else ".mcap"
        return rosbag2.Reader.STORAGE_PLUGINS[plugin](self.path)

    @contextmanager
    def _trouble(self) -> Iterator[None]:
        """Turn whatever a damaged file provokes inside rosbags into a `RecordingError`."""
        try:
            yield
        except RecordingError:
            raise
        except Exception as error:
            repair = "rosbag reindex" if self._is_ros1 else "ros2 bag reindex (or `mcap recover` for an .mcap)"
            detail = str(error) or type(error).__name__
            raise RecordingError(
                f"{self.path}: truncated, damaged or never closed, and cannot be read in full ({detail}); "
                f"copy it again, or repair it with {repair}"
            ) from error

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self._reader.close()

    @property
    def format(self) -> str:
        """What kind of bag it is."""
        return "ROS 1 bag" if self._is_ros1 else "ROS 2 bag"

    @property
    def topics(self) -> list[Topic]:
        """The topics by name, with the types of their messages in the form ``package/msg/Name``."""
        counts: Counter[tuple[str, str]] = Counter()
        for connection in self._reader.connections:
            counts[connection.topic, connection.msgtype] += connection.msgcount
        return [Topic(name, kind, count) for (name, kind), count in sorted(counts.items())]

    def of_type(self, *kinds: str) -> list[str]:
        """Return the names of the topics whose messages are of one of the types, such as ``sensor_msgs/msg/LaserScan``."""
        return sorted({topic.name for topic in self.topics if topic.type in kinds})

    def messages(self, topics: Collection[str]) -> Iterator[tuple[str, Any]]:
        """Yield (topic, message) of the given topics in the order of recording.

        Raises
        ------
        RecordingError
            If the bag ends early, a message cannot be decoded, or the definition of its type cannot be understood.
        """
        connections = [connection for connection in self._reader.connections if connection.topic in topics]
        if not connections:
            return
        for connection in connections:
            self._define(connection)
        decode = self._types.deserialize_ros1 if self._is_ros1 else self._types.deserialize_cdr
        count = 0
        with self._trouble():
            for connection, _, data in self._reader.messages(connections):
                message = decode(data, connection.msgtype)
                count += 1
                yield connection.topic, message
        expected = sum(connection.msgcount for connection in connections)
        if count != expected:
            raise RecordingError(
                f"{self.path}: its index promises {expected} messages on {', '.join(sorted(topics))}, but {count} can be read; "
                "the bag is truncated: copy it again, or rebuild its index with `ros2 bag reindex` or `rosbag reindex`"
            )

    def _define(self, connection: Any) -> None:
        """Make the type of a connection's messages known."""
        if connection.msgtype in self._types.fielddefs:
            return
        definition = connection.msgdef
        try:
            if definition.format == MessageDefinitionFormat.MSG:
                definitions = get_types_from_msg(definition.data, connection.msgtype)
            elif definition.format == MessageDefinitionFormat.IDL:
                parts = definition.data.split(_IDL_RULE)[1:] if definition.data.startswith(_IDL_RULE) else [definition.data]
                definitions = {}
                for part in parts:
                    definitions.update(get_types_from_idl(part.split("\n", 1)[1] if part.startswith("IDL: ") else part))
            elif connection.msgtype in self._default.fielddefs:
                logger.info("%s: holds no definition of %s; taking the one of ROS 2 Jazzy", self.path, connection.msgtype)
                definitions = dict(self._default.fielddefs)
            else:
                raise RecordingError(
                    f"{self.path}: holds no definition of the message type {connection.msgtype} on {connection.topic}, and it is no "
                    "standard type; record the bag with definitions (MCAP does), or choose another topic"
                )
            known = self._types.fielddefs
            self._types.register({name: fields for name, fields in definitions.items() if name not in known})
        except (TypesysError, AssertionError, IndexError, KeyError, ValueError) as error:
            raise RecordingError(
                f"{self.path}: the definition of the message type {connection.msgtype} on {connection.topic} cannot be understood ({error})"
            ) from error


def _check_complete(file: Path) -> None:
    """Refuse an SQLite file that is shorter than it says, or whose last changes lie in a second file; SQLite itself may not notice."""
    with file.open("rb") as stream:
        head = stream.read(100)
    if len(head) < 100 or not head.startswith(SQLITE_MAGIC):
        return
    page_size = struct.unpack(">H", head[16:18])[0]
    pages = struct.unpack(">I", head[28:32])[0]
    expected = (65536 if page_size == 1 else page_size) * pages
    counted = head[24:28] == head[92:96]  # else an old SQLite wrote the file and did not keep the number of pages
    if counted and file.stat().st_size < expected:
        raise RecordingError(
            f"{file}: truncated, {file.stat().st_size} of {expected} bytes; copy it again, or save what is left with `ros2 bag reindex`"
        )
    journal = file.with_name(file.name + "-wal")
    if journal.exists() and journal.stat().st_size:
        raise RecordingError(
            f"{file}: the recording was not closed, its last messages are still in {journal.name}; "
            f"run `sqlite3 {file} 'pragma wal_checkpoint(truncate)'` to move them in"
        )
