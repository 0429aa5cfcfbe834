//! A Ballista scheduler with polycsg's functions.
use ballista_core::error::Result;
use ballista_scheduler::cluster::BallistaCluster;
use ballista_scheduler::config::SchedulerConfig;
use ballista_scheduler::scheduler_process::start_server;
use clap::Parser;
use std::net::{IpAddr, SocketAddr};
use std::sync::Arc;

/// A Ballista scheduler with polycsg's functions.
#[derive(Parser)]
struct SchedulerArguments {
    /// The address to listen on.
    #[arg(long, default_value = "127.0.0.1")]
    host: IpAddr,
    /// The port to listen on.
    #[arg(long, default_value_t = 50050)]
    port: u16,
    /// After so many seconds without a heartbeat an executor counts as lost, and its work is done again.
    #[arg(long, default_value_t = 10)]
    executor_timeout: u64,
}

#[tokio::main]
async fn main() -> Result<()> {
    let arguments = SchedulerArguments::parse();
    env_logger::init_from_env(env_logger::Env::default().default_filter_or("info"));
    let config = SchedulerConfig {
        bind_host: arguments.host.to_string(),
        bind_port: arguments.port,
        external_host: arguments.host.to_string(),
        executor_timeout_seconds: arguments.executor_timeout,
        expire_dead_executor_interval_seconds: arguments.executor_timeout.div_ceil(5),
        no_executors_grace_period_seconds: arguments.executor_timeout,
        override_session_builder: Some(Arc::new(polycsg_ballista::session_state)),
        ..SchedulerConfig::default()
    };
    let cluster = BallistaCluster::new_from_config(&config).await?;
    start_server(cluster, SocketAddr::new(arguments.host, arguments.port), Arc::new(config)).await
}
