//! The parent's side of a child: questions with a time limit.

use crate::worker::Reply;
use std::io::{BufRead, BufReader, Write};
use std::process::{Child as Process, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

/// Why there is no figure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Failure {
    /// It is not made for such a job.
    Unfit,
    /// It took longer than it may.
    Slow,
    /// It refused or crashed.
    Error(String),
}

/// A running child; killed when dropped.
pub(crate) struct Child {
    process: Process,
    questions: ChildStdin,
    replies: Receiver<Reply>,
}

impl Child {
    /// Starts an engine on an input, in a process whose memory goes back to the system as soon as it is freed when
    /// `trimmed`: then its growth is what a call needs.
    pub(crate) fn start(engine: &str, family: &str, size: usize, trimmed: bool) -> Result<Child, String> {
        let program = std::env::current_exe().map_err(|error| error.to_string())?;
        let mut command = Command::new(program);
        command.args(["--worker", engine, family, &size.to_string()]);
        if trimmed {
            command.env("MALLOC_TRIM_THRESHOLD_", "0").env("MALLOC_MMAP_THRESHOLD_", "65536");
        }
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut process = command.spawn().map_err(|error| error.to_string())?;
        let (Some(questions), Some(answers)) = (process.stdin.take(), process.stdout.take()) else {
            return Err("a child has no pipes".to_owned());
        };
        let (sender, replies) = channel();
        std::thread::spawn(move || {
            let lines = BufReader::new(answers).lines().map_while(Result::ok);
            let replies = lines.filter_map(|line| serde_json::from_str(&line).ok());
            let _ = replies.map(|reply| sender.send(reply)).find(Result::is_err);
        });
        Ok(Child { process, questions, replies })
    }

    /// The next reply.
    pub(crate) fn wait(&mut self, limit: Duration) -> Result<Reply, Failure> {
        match self.replies.recv_timeout(limit) {
            Ok(Reply::Failed(message)) => Err(Failure::Error(message)),
            Ok(reply) => Ok(reply),
            Err(RecvTimeoutError::Timeout) => Err(Failure::Slow),
            Err(RecvTimeoutError::Disconnected) => Err(Failure::Error("crashed".to_owned())),
        }
    }

    /// A question and its reply.
    pub(crate) fn ask(&mut self, question: &str, limit: Duration) -> Result<Reply, Failure> {
        writeln!(self.questions, "{question}").map_err(|_| Failure::Error("crashed".to_owned()))?;
        self.wait(limit)
    }
}

impl Drop for Child {
    fn drop(&mut self) {
        // Both fail only when it has ended by itself.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
